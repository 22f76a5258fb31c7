#include "eval/sources/source.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/kinect/disparity.h"
#include "eval/command_test.h"
#include "eval/frame_formats/color_view.h"
#include "eval/sources/paired_recording.h"
#include "eval/sources/tum_source.h"
#include "reports/estimates.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

RgbdCalibration tiny_calibration() {
  RgbdCalibration calibration;
  calibration.ir = calibration.rgb = {4, 3, 10, 10, 1.5, 1};
  return calibration;
}

/// Color images are 4 or, at odd indexes, 5 pixels wide.
TrackSource paired(std::vector<int64_t> depth_us, std::vector<int64_t> color_us) {
  return paired_source("here", tiny_calibration(),
                       {std::move(depth_us), std::move(color_us),
                        [](size_t i) { return DepthImage(4, 3, static_cast<float>(i + 1)); },
                        [](size_t i) { return ColorImage(4 + i % 2, 3); }},
                       20'000);
}

TEST(PairedSource, PairsByTimeWhateverTheOrder) {
  TrackSource source = paired({200'000, 100'000, 300'000}, {110'000, 500'000, 205'000});
  EXPECT_EQ(source.frame_count, 2);
  EXPECT_EQ(source.dropped(), 1);
  const std::optional<DeviceFrame> first = source.device->next_frame(), second = source.device->next_frame();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->depth, DepthImage(4, 3, 2.0f));
  EXPECT_EQ(first->depth_timestamp_us, 100'000);
  EXPECT_EQ(first->color_timestamp_us, 110'000);
  EXPECT_EQ(second->depth, DepthImage(4, 3, 1.0f));
  EXPECT_TRUE(second->raw_disparity.empty());
  EXPECT_FALSE(source.device->next_frame());
}

TEST(PairedSource, LosesOnlyTheFrameOfAnotherSize) {
  TrackSource source = paired({100'000, 200'000, 300'000}, {100'000, 200'000, 300'000});
  EXPECT_TRUE(source.device->next_frame());
  EXPECT_THAT([&] { source.device->next_frame(); },
              testing::ThrowsMessage<FrameError>(
                  HasSubstr("here: color image at 0.200000 s: found 5x3, expected 4x3 as calibrated")));
  EXPECT_TRUE(source.device->next_frame());
}

TEST(PairedSource, NeedsAPair) {
  EXPECT_THAT([] { paired({100'000}, {130'000}); },
              testing::ThrowsMessage<Error>(
                  HasSubstr("frames: found 1 depth and 1 color images, expected at least one pair within 20 ms")));
}

TEST(TumList, IsReadLineByLine) {
  const std::vector<TumImage> images = parse_tum_list(
      "# timestamp filename\n1305031102.175304 rgb/1305031102.175304.png\n\n0.5\tb c.png \n", "rgb.txt");
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].timestamp_us, 1'305'031'102'175'304);
  EXPECT_EQ(images[0].name, "rgb/1305031102.175304.png");
  EXPECT_EQ(images[1].timestamp_us, 500'000);
  EXPECT_EQ(images[1].name, "b c.png");
  for (const char* wrong : {"1.5", "x a.png", "-1 a.png", "nan a.png", "1e30 a.png", "1 ../a.png", "1 /a.png"})
    EXPECT_THROW(parse_tum_list(wrong, "rgb.txt"), Error) << wrong;
}

TEST(Sources, AreNamedWhereOneIsUnknown) {
  for (const char* wrong : {"live", "tum", "tum:", "freenect:", "fakenect", "mcap:"})
    EXPECT_THAT(
        [&] { open_source({.source = wrong, .calibration = "", .topics = ""}, true); },
        testing::ThrowsMessage<Error>(HasSubstr(
            "expected one of bag:FILE, fakenect:FOLDER, freenect[:INDEX], mcap:FILE, oni:FILE, tum:FOLDER")))
        << wrong;
}

TEST(Sources, TakeOnlyTheirOwnFlags) {
  EXPECT_THAT(
      [] { open_source({.source = "tum:a", .calibration = "", .topics = "color=/c"}, true); },
      testing::ThrowsMessage<Error>(HasSubstr("--topics: --source: found tum:a, expected bag:FILE or mcap:FILE")));
  EXPECT_THAT([] { open_source({.source = "oni:a", .calibration = "", .topics = "", .every_frame = true}, true); },
              testing::ThrowsMessage<Error>(HasSubstr("--every-frame: --source: found oni:a, expected freenect")));
}

class SourcesLong : public CommandTest {
 protected:
  void render(const std::string& format) const {
    expect_fine(run_glovebench(
        {"render", "--trajectory", path("good.json"), "--format", format, "-o", path(format), "--quiet"}));
  }
  ProgramRun track_source(const std::string& source, const std::string& output,
                          const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"track", "--source", source, "--database", "DB_open_power", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  std::vector<reports::Estimate> tracked(const std::string& source) const {
    const std::string output = path("estimates.csv");
    expect_fine(track_source(source, output));
    return reports::read_estimates(output);
  }
  /// `T`: from the recording's camera to the depth camera.
  void expect_near(const std::string& source, const Eigen::Isometry3d& T, double most_mm, double most_deg) {
    render("fakenect");
    const std::vector<reports::Estimate> direct = tracked("fakenect:" + path("fakenect")), found = tracked(source);
    ASSERT_EQ(found.size(), direct.size());
    for (size_t i = 0; i < direct.size(); ++i) {
      ASSERT_EQ(direct[i].status, TrackStatus::tracked);
      ASSERT_EQ(found[i].status, TrackStatus::tracked);
      EXPECT_EQ(found[i].timestamp_us, direct[i].timestamp_us);
      const Eigen::Isometry3d difference = direct[i].T_camera_hand.inverse() * (T * found[i].T_camera_hand);
      EXPECT_LT(1000 * difference.translation().norm(), most_mm) << i;
      EXPECT_LT(degrees_from_radians(Eigen::AngleAxisd(difference.linear()).angle()), most_deg) << i;
      EXPECT_LT(degrees_from_radians((found[i].posture - direct[i].posture).cwiseAbs().maxCoeff()), 3) << i;
    }
  }
};

float most_difference(const DepthImage& a, const DepthImage& b) {
  float most = 0;
  for (size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

TEST_F(SourcesLong, FramesAreThoseOfTheRecording) {
  for (const char* format : {"fakenect", "mcap", "tum"}) render(format);
  const auto opened = [&](const std::string& source) {
    return open_source({.source = source, .calibration = "", .topics = ""}, true).device;
  };
  const std::unique_ptr<Device> direct = opened("fakenect:" + path("fakenect")),
                                mcap = opened("mcap:" + path("mcap/good.mcap")), tum = opened("tum:" + path("tum"));
  const RgbdCalibration& truth = direct->calibration();
  EXPECT_EQ(mcap->calibration().ir, truth.ir);
  EXPECT_EQ(mcap->calibration().rgb, truth.rgb);
  EXPECT_TRUE(mcap->calibration().T_rgb_ir.isApprox(truth.T_rgb_ir, 1e-12));
  EXPECT_EQ(tum->calibration().ir, truth.rgb);
  for (int i = 0; i < kFrames; ++i) {
    const DeviceFrame expected = *direct->next_frame(), from_mcap = *mcap->next_frame(),
                      from_tum = *tum->next_frame();
    const DepthImage depth = depth_of(expected, {});
    for (const DeviceFrame& found : {from_mcap, from_tum}) {
      EXPECT_EQ(found.color, expected.color);
      EXPECT_EQ(found.depth_timestamp_us, expected.depth_timestamp_us);
      EXPECT_EQ(found.color_timestamp_us, expected.color_timestamp_us);
    }
    EXPECT_LE(most_difference(from_mcap.depth, depth), 0.5001e-3f) << "a step of 1 mm";
    EXPECT_LE(most_difference(from_tum.depth, register_depth(depth, truth)), 0.1001e-3f) << "a step of 0.2 mm";
  }
  EXPECT_FALSE(mcap->next_frame() || tum->next_frame());
}

// Rounding to 1 mm moves the alignment of the 117 frames of Tr4 by 0.8 mm and 0.6 degrees (median), at most by 4.6
// mm and 2.8 degrees. Their errors do not grow.
TEST_F(SourcesLong, McapGivesThePosesOfTheRecording) {
  render("mcap");
  expect_near("mcap:" + path("mcap/good.mcap"), Eigen::Isometry3d::Identity(), 3, 2);
}

// Depth also moves to the nearest pixel of the color camera: 1.2 mm and 1.0 degrees, at most 5.3 mm and 4.8
// degrees.
TEST_F(SourcesLong, TumGivesThePosesOfTheRecordingInTheColorCamera) {
  render("tum");
  expect_near("tum:" + path("tum"), synthetic_calibration().T_rgb_ir.inverse(), 5, 3);
}

TEST_F(SourcesLong, TumNamesDamagedImagesAndGoesOn) {
  render("tum");
  fs::remove(path("tum/depth/0.133334.png"));
  write_file(path("tum/depth/0.066667.png"), encode_png(Image<uint8_t>(640, 480)));
  const ProgramRun run = track_source("tum:" + path("tum"), path("x.csv"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 2) << run.err;
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("skipped: "), HasSubstr("depth/0.133334.png"), HasSubstr("depth/0.066667.png")));
  EXPECT_THAT(run.out, HasSubstr("2 of 4 frames tracked, 2 unusable"));
}

TEST_F(SourcesLong, TumNeedsACalibrationAndLists) {
  render("tum");
  fs::remove(path("tum/manifest.json"));
  fs::rename(path("tum/calibration.json"), path("mine.json"));
  const std::string source = "tum:" + path("tum");
  EXPECT_THAT(refusal(track_source(source, path("x.csv"))),
              AllOf(HasSubstr("tum/calibration.json: file: found none"), HasSubstr("--calibration")));
  expect_fine(track_source(source, path("x.csv"), {"--calibration", path("mine.json")}));
  write_file(path("tum/rgb.txt"), "0.0\n");
  EXPECT_THAT(refusal(track_source(source, path("y.csv"), {"--calibration", path("mine.json")})),
              HasSubstr("tum/rgb.txt: line 1: found \"0.0\""));
}

}  // namespace
}  // namespace glovebench::eval
