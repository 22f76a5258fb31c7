#include "eval/sources/oni_source.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/adapters/openni2/oni_player.h"
#include "core/adapters/openni2/test_camera.h"
#include "core/test_error.h"
#include "eval/command_test.h"
#include "eval/sources/source.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}
std::string oni_head(uint16_t patch = 1, uint32_t nodes = 2) {
  return "NI10" + bytes_of(uint8_t{1}, uint8_t{0}, patch, uint32_t{0}, uint64_t{0}, nodes);
}
std::string oni_record(uint32_t type, uint32_t node, const std::string& fields = "",
                       const std::string& payload = "") {
  return std::string("NIR\0", 4) + bytes_of(type, node, static_cast<uint32_t>(28 + fields.size())) +
         bytes_of(static_cast<uint32_t>(payload.size()), uint64_t{0}) + fields + payload;
}
std::string oni_node(uint32_t node, uint32_t type, uint64_t seek_table = 0) {
  return oni_record(13, node,
                    bytes_of(uint32_t{2}) + std::string("a\0", 2) +
                        bytes_of(type, uint32_t{0}, uint32_t{1}, uint64_t{0}, uint64_t{0}, seek_table));
}
std::string oni_image(uint32_t node, uint64_t time_us, size_t bytes = 3) {
  return oni_record(10, node, bytes_of(time_us, uint32_t{1}), std::string(bytes, 'x'));
}
const std::string kOniEnd = oni_record(11, 0);

std::string oni_refusal(const std::string& file) {
  return thrown_by([&] { parse_oni_times(file, "a.oni"); });
}

TEST(OniTimes, AreThoseOfDepthAndColorUpToTheEnd) {
  const OniTimes times =
      parse_oni_times(oni_head() + oni_node(1, 3) + oni_node(2, 2) + oni_node(0, 5) + oni_image(1, 5) +
                          oni_image(2, 7) + oni_image(0, 8) + oni_image(2, 9) + kOniEnd + "whatever",
                      "a.oni");
  EXPECT_THAT(times.color_us, ElementsAre(5));
  EXPECT_THAT(times.depth_us, ElementsAre(7, 9));
}

TEST(OniTimes, NeedAWholeRecording) {
  const std::string file = oni_head() + oni_node(1, 2) + oni_image(1, 5) + kOniEnd;
  EXPECT_EQ(oni_refusal(file), "");
  for (size_t size = 0; size < file.size(); ++size)
    EXPECT_THAT(oni_refusal(file.substr(0, size)), testing::StartsWith("a.oni: ")) << size;
  EXPECT_EQ(oni_refusal("PNG..."),
            "a.oni: first bytes: found \"PNG.\", expected \"NI10\" of a recording of OpenNI2's recorder");
  EXPECT_EQ(oni_refusal(oni_head(0) + kOniEnd), "a.oni: version: found 1.0.0, expected 1.0.1");
}

TEST(OniTimes, RefuseWhatOpenNi2WouldTrust) {
  EXPECT_THAT(oni_refusal(oni_head(1, 1'000'000) + kOniEnd), HasSubstr("found node 1000000"));
  EXPECT_THAT(oni_refusal(oni_head() + oni_node(1, 2, 24) + kOniEnd),
              HasSubstr("seek table: found none at byte 24"));
  EXPECT_EQ(oni_refusal(oni_head() + oni_record(14, 1) + oni_node(1, 2, 24) + kOniEnd), "");
  EXPECT_THAT(oni_refusal(oni_head() + oni_record(6, 1, std::string(1 << 17, 'x')) + kOniEnd),
              HasSubstr("record at byte 24: found damaged data, expected a record"));
  const std::string named = oni_record(3, 1, bytes_of(uint32_t{3}) + std::string("ab\0", 3));
  EXPECT_EQ(oni_refusal(oni_head() + named + kOniEnd), "");
  for (const char* name : {"a\xE4\0", "abc"})
    EXPECT_THAT(oni_refusal(oni_head() + oni_record(3, 1, bytes_of(uint32_t{3}) + std::string(name, 3)) + kOniEnd),
                HasSubstr("found damaged data, expected a name"));
  EXPECT_THAT(oni_refusal(oni_head() + oni_node(1, 2) + oni_image(1, 0, 6'000'000) + kOniEnd),
              HasSubstr("found damaged data, expected an image"));
}

/// Recordings by OpenNI2's recorder.
class OniSource : public CommandTest {
 protected:
  void SetUp() override {
    if (!kHasOpenNi2) GTEST_SKIP() << "built without OpenNI2";
    CommandTest::SetUp();
  }
  /// The words of test_camera.h.
  std::string recorded(std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {build_paths::program("record_oni"), path("a.oni")});
    const ProgramRun run = run_program(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path("a.oni");
  }
  static TrackSource opened(const std::string& file) {
    return open_source({.source = "oni:" + file, .calibration = "", .topics = ""}, true);
  }
  std::string track_refusal(const std::string& file) const {
    return refusal(run_glovebench(
        {"track", "--source", "oni:" + file, "--database", "DB_open_power", "-o", path("estimates.csv")}));
  }
};

void expect_test_images(TrackSource source, double steps_per_m) {
  // Depth every 33 ms, color every 41 ms.
  const std::vector<int> nearest_colors = {0, 1, 2, 2, 3, 4};
  ASSERT_EQ(source.frame_count, test_camera::kFrames);
  for (int i = 0; i < test_camera::kFrames; ++i) {
    const DeviceFrame frame = source.device->next_frame().value();
    EXPECT_EQ(frame.depth_timestamp_us, i * test_camera::kDepthPeriod_us);
    EXPECT_EQ(frame.color_timestamp_us, nearest_colors[i] * test_camera::kColorPeriod_us);
    DepthImage depth(test_camera::kDepthWidth, test_camera::kDepthHeight);
    for (int v = 0; v < depth.height(); ++v)
      for (int u = 0; u < depth.width(); ++u)
        depth(u, v) = static_cast<float>(test_camera::depth_step(u, v, i) / steps_per_m);
    EXPECT_EQ(frame.depth, depth) << i;
    ColorImage color(test_camera::kColorWidth, test_camera::kColorHeight);
    for (int v = 0; v < color.height(); ++v)
      for (int u = 0; u < color.width(); ++u) color(u, v) = test_camera::color(u, v, nearest_colors[i]);
    EXPECT_EQ(frame.color, color) << i;
  }
  EXPECT_FALSE(source.device->next_frame());
  EXPECT_EQ(source.dropped(), 0);
}

TEST_F(OniSource, HasTheImagesOfTheRecording) {
  expect_test_images(opened(recorded()), 1000);
  expect_test_images(opened(recorded({"100um"})), 10'000);
}

TEST_F(OniSource, TurnsMirroredImagesBack) { expect_test_images(opened(recorded({"mirrored"})), 1000); }

TEST_F(OniSource, HasTheFieldOfViewAsCalibration) {
  const TrackSource source = opened(recorded());
  const RgbdCalibration& calibration = source.device->calibration();
  EXPECT_EQ(calibration.rgb.width, test_camera::kColorWidth);
  EXPECT_EQ(calibration.ir.height, test_camera::kDepthHeight);
  EXPECT_NEAR(calibration.rgb.fx, 320 / std::tan(0.5), 1e-4);
  EXPECT_NEAR(calibration.rgb.fy, 240 / std::tan(0.375), 1e-4);
  EXPECT_NEAR(calibration.ir.fx, 160 / std::tan(0.5), 1e-4);
  EXPECT_DOUBLE_EQ(calibration.rgb.cx, 319.5);
  EXPECT_DOUBLE_EQ(calibration.ir.cy, 119.5);
  EXPECT_TRUE(calibration.T_rgb_ir.isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(OniSource, NeedsDepthAndColor) {
  EXPECT_THAT(track_refusal(recorded({"depth_only"})),
              HasSubstr("a.oni: color stream: found none, expected RGB888"));
  EXPECT_THAT(track_refusal(recorded({"yuv"})), HasSubstr("a.oni: color stream: found YUV422, expected RGB888"));
}

TEST_F(OniSource, NeedsAWholeRecording) {
  const std::string file = read_file(recorded());
  for (const size_t size : {size_t{0}, size_t{500}, size_t{3000}, size_t{200'000}}) {
    write_file(path("b.oni"), file.substr(0, size));
    EXPECT_THAT(track_refusal(path("b.oni")), HasSubstr("b.oni: ")) << size;
  }
  write_file(path("b.oni"), std::string(3000, 'x'));
  EXPECT_THAT(track_refusal(path("b.oni")), HasSubstr("b.oni: first bytes: found \"xxxx\""));
  EXPECT_THAT(track_refusal(path("none.oni")), HasSubstr("none.oni"));
}

TEST_F(OniSource, IsTracked) {
  recorded();
  const ProgramRun run = run_glovebench(
      {"track", "--source", "oni:" + path("a.oni"), "--database", "DB_open_power", "-o", path("estimates.csv")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("0 of 6 frames tracked")) << "they show no hand";
  EXPECT_THAT(run.err, HasSubstr("a.oni: depth counts as registered to color; if it is not, give --calibration"));
}

}  // namespace
}  // namespace glovebench::eval
