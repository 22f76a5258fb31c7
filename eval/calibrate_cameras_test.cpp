// `glovebench calibrate cameras`, from pictures to a calibration that `track` takes.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/calibration/test_board.h"
#include "eval/command_test.h"
#include "render/pictures.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using calibration::BoardCamera;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr calibration::Chessboard kBoard = {9, 6, 0.025};
constexpr int kPictures = 12;

class CalibrateCamerasLong : public CommandTest {
 protected:
  /// PNG pictures of the synthetic Kinect, without lens distortion.
  void write_pictures(const RgbdCalibration& truth) const {
    const auto poses = calibration::poses_before(truth, kBoard, kPictures, 3);
    const BoardCamera ir(truth.ir, truth.ir_lens), rgb(truth.rgb, truth.rgb_lens);
    RandomStream noise(1, "calibrate cameras", 0, "pictures");
    for (int i = 0; i < kPictures; ++i) {
      write_gray(path("ir/" + std::to_string(i) + ".png"), ir.picture(poses[i], kBoard, noise));
      write_gray(path("rgb/" + std::to_string(i) + ".png"), rgb.picture(truth.T_rgb_ir * poses[i], kBoard, noise));
    }
  }
  static void write_gray(const std::string& file, const Image<uint8_t>& gray) {
    ColorImage color(gray.width(), gray.height());
    for (size_t i = 0; i < gray.size(); ++i) color[i] = {gray[i], gray[i], gray[i]};
    render::write_png(file, color);
  }
  ProgramRun calibrate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"calibrate", "cameras",   "--ir", path("ir"),
                                          "--rgb",     path("rgb"), "-o",   path("own.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  std::string refused(const std::vector<std::string>& more) const {
    const ProgramRun run = calibrate(more);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(path("own.json")));
    return run.err;
  }
};

TEST_F(CalibrateCamerasLong, GivesACalibrationThatTrackTakes) {
  const RgbdCalibration truth = synthetic_calibration();
  write_pictures(truth);
  write_file(path("rgb/99.png"), "no picture");
  const ProgramRun run = calibrate({"--report", path("report.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("| IR | 57"), HasSubstr("12 pairs, error 0.0"),
                             HasSubstr("left out, RGB 99: "), HasSubstr("own.json: both cameras")));
  const RgbdCalibration own = load_calibration(path("own.json"));
  EXPECT_TRUE(own.has_lens()) << "what noise makes of none";
  EXPECT_NEAR(own.ir.fx, truth.ir.fx, 0.005 * truth.ir.fx);
  EXPECT_NEAR(own.rgb.fy, truth.rgb.fy, 0.005 * truth.rgb.fy);
  EXPECT_LT((own.T_rgb_ir.translation() - truth.T_rgb_ir.translation()).norm(), 0.001);
  const json report = json::parse(read_file(path("report.json")));
  EXPECT_EQ(report.at("ir").at("views").size(), 12U);
  EXPECT_EQ(report.at("rgb").at("left_out").at(0).at("name"), "99");
  EXPECT_LT(report.at("stereo").at("error_px"), 0.2);

  ASSERT_EQ(calibrate({"--ir-offset", "5", "4"}).exit_code, 0) << "as of libfreenect's IR pictures";
  const RgbdCalibration moved = load_calibration(path("own.json"));
  EXPECT_EQ(moved.ir.cx, own.ir.cx - 5);
  EXPECT_EQ(moved.ir.cy, own.ir.cy - 4);
  save_calibration(own, path("own.json"));

  render_recording("good.json", "dump");
  const auto position_mm = [&](const std::string& estimates, const std::vector<std::string>& more) {
    expect_fine(track("dump", "DB_open_power", estimates, more));
    const std::string lines = read_file(path(estimates));
    const json position = json::parse(lines.substr(0, lines.find('\n'))).at("position_mm");
    return Eigen::Vector3d(position[0], position[1], position[2]);
  };
  const Eigen::Vector3d nominal = position_mm("truth.jsonl", {});
  const Eigen::Vector3d calibrated = position_mm("own.jsonl", {"--calibration", path("own.json")});
  EXPECT_NE(nominal, calibrated);
  EXPECT_LT((nominal - calibrated).norm(), 6) << "half a percent of 700 mm, and what it does to the labels";
}

/// The same movement with another focal length gives other pictures and similar errors.
TEST_F(CalibrateCamerasLong, RunAndRenderTakeIt) {
  RgbdCalibration wide = synthetic_calibration();
  wide.ir.fx = wide.ir.fy = 500;
  wide.ir_lens.k1 = 0.1;  // the pictures are taken as corrected
  save_calibration(wide, path("wide.json"));
  const json own = run_trajectory("good.json", "own");
  const json results = run_trajectory("good.json", "wide", {"--calibration", path("wide.json")});
  EXPECT_FALSE(own.at("configuration").contains("calibration"));
  EXPECT_EQ(results.at("configuration").at("calibration").at("ir").at("fx_px"), 500);
  EXPECT_EQ(results.at("experiments").at(0).at("coverage").at("covered"), kFrames);
  EXPECT_NE(results.at("experiments"), own.at("experiments"));
  const ProgramRun compared = run_glovebench({"compare", path("own"), path("wide")});
  EXPECT_THAT(compared.out, HasSubstr("calibration.ir.fx_px"));
  expect_fine(run_glovebench({"explain", path("wide"), "1", "--trajectory", path("good.json")}));

  expect_fine(run_glovebench({"render", "--trajectory", path("good.json"), "--calibration", path("wide.json"),
                              "--format", "fakenect", "-o", path("dump")}));
  EXPECT_EQ(load_calibration(path("dump/calibration.json")).ir, wide.ir);
  EXPECT_FALSE(load_calibration(path("dump/calibration.json")).has_lens());
  expect_fine(track("dump", "DB_open_power", "estimates.jsonl"));
  write_file(path("bad.json"), "{}");
  EXPECT_THAT(refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power",
                                      "--calibration", path("bad.json"), "-o", path("x")})),
              HasSubstr("bad.json: version: found nothing"));
}

TEST_F(CalibrateCamerasLong, NamesWhatItCannotUse) {
  EXPECT_THAT(refused({}), HasSubstr("ir: folder: found"));
  write_gray(path("ir/1.png"), Image<uint8_t>(640, 480, 80));
  write_gray(path("rgb/1.png"), Image<uint8_t>(640, 480, 80));
  EXPECT_THAT(refused({}), AllOf(HasSubstr("IR views: views with a whole chessboard: found 0 (left out: "),
                                 HasSubstr("), expected at least 5")));
  EXPECT_THAT(refused({"--board", "9"}), HasSubstr("--board: value: found 9"));
  EXPECT_THAT(refused({"--board", "9x6x2"}), HasSubstr("--board: value: found 9x6x2"));
  EXPECT_THAT(refused({"--board", "6x6"}), HasSubstr("columns and rows: found 6 each"));
  EXPECT_THAT(refused({"--square-mm", "nan"}), HasSubstr("square"));
  EXPECT_THAT(refused({"--ir-offset", "nan", "0"}),
              HasSubstr("--ir-offset: found nan, expected a number from -16 to 16"));
  EXPECT_THAT(refused({"--lens", "fisheye"}),
              HasSubstr("--lens: found fisheye, expected one of none, radial, full"));
  EXPECT_THAT(refusal(run_glovebench({"calibrate", "cameras", "--ir", "fakenect:" + path("ir"), "--rgb",
                                      path("rgb"), "-o", path("own.json")})),
              HasSubstr("INDEX.txt"));
}

}  // namespace
}  // namespace glovebench::eval
