#include "core/camera/rgbd_calibration.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using nlohmann::json;

std::string calibration_error(const json& content) {
  return thrown_by([&] { calibration_from_json(content, "here.json"); });
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

TEST(SyntheticCalibration, IsThatOfTheDesign) {
  const RgbdCalibration calibration = synthetic_calibration();
  EXPECT_EQ(calibration.ir.fx, 575.816);
  EXPECT_EQ(calibration.rgb.fx, 525.0);
  EXPECT_NEAR(calibration.T_rgb_ir.translation().norm(), 0.024, 1e-12);
  EXPECT_GT(std::abs(calibration.T_rgb_ir.translation().x()), 0.0235);
  const double angle = Eigen::AngleAxisd(calibration.T_rgb_ir.linear()).angle();
  EXPECT_GT(angle, radians_from_degrees(0.1));
  EXPECT_LT(angle, radians_from_degrees(1.0));
  for (const PinholeCamera& camera : {calibration.ir, calibration.rgb}) {
    EXPECT_NEAR(camera.cx, 319.5, 5);
    EXPECT_NEAR(camera.cy, 239.5, 5);
  }
}

TEST(Calibration, ReturnsFromItsFileBitForBit) {
  const std::string folder = test_folder();
  const RgbdCalibration saved = synthetic_calibration();
  save_calibration(saved, folder + "/calibration.json");
  const RgbdCalibration loaded = load_calibration(folder + "/calibration.json");
  EXPECT_EQ(loaded.ir, saved.ir);
  EXPECT_EQ(loaded.rgb, saved.rgb);
  EXPECT_EQ(loaded.T_rgb_ir.matrix(), saved.T_rgb_ir.matrix());
}

TEST(Calibration, HoldsADisparityLineOrNone) {
  const json plain = to_json(synthetic_calibration());
  EXPECT_FALSE(plain.contains("disparity")) << "recordings and hashes stay as they were";
  EXPECT_FALSE(calibration_from_json(plain, "here.json").disparity);

  RgbdCalibration own = nominal_kinect_calibration();
  own.disparity = DisparityLine{-0.0030711016, 3.3309495161};
  const RgbdCalibration read = calibration_from_json(json::parse(to_json(own).dump()), "here.json");
  EXPECT_EQ(read.disparity, own.disparity);
  EXPECT_EQ(read.ir, own.ir);
}

TEST(Calibration, HoldsLensesOrNone) {
  const json plain = to_json(synthetic_calibration());
  EXPECT_FALSE(plain["ir"].contains("distortion")) << "recordings and hashes stay as they were";
  EXPECT_FALSE(calibration_from_json(plain, "here.json").has_lens());

  RgbdCalibration own = nominal_kinect_calibration();
  own.rgb_lens = {.k1 = 0.265, .k2 = -0.84, .p1 = -0.0019, .p2 = 0.0014, .k3 = 0.912};
  const RgbdCalibration read = calibration_from_json(json::parse(to_json(own).dump()), "here.json");
  EXPECT_EQ(read.rgb_lens, own.rgb_lens);
  EXPECT_TRUE(read.ir_lens.is_none());
  EXPECT_TRUE(read.has_lens());
  EXPECT_FALSE(read.rectified().has_lens());
  EXPECT_EQ(read.rectified().rgb, own.rgb);

  json bad = to_json(own);
  bad["rgb"]["distortion"].erase("k3");
  EXPECT_TRUE(starts_with(calibration_error(bad), "here.json: rgb.distortion.k3: found nothing"))
      << calibration_error(bad);
  bad["rgb"]["distortion"]["k3"] = "0";
  EXPECT_TRUE(starts_with(calibration_error(bad), "here.json: rgb.distortion.k3: found \"0\""))
      << calibration_error(bad);
  bad["rgb"]["distortion"] = json::array({0, 0, 0, 0, 0});
  EXPECT_TRUE(starts_with(calibration_error(bad), "here.json: rgb.distortion: found an array of"))
      << calibration_error(bad);
}

TEST(Calibration, NominalKinectHasItsRgbCameraToTheRight) {
  const RgbdCalibration nominal = nominal_kinect_calibration();
  EXPECT_EQ(nominal.T_rgb_ir * Eigen::Vector3d(0.025, 0, 1), Eigen::Vector3d(0, 0, 1)) << "on its optical axis";
  EXPECT_EQ(nominal.ir.cx, (nominal.ir.width - 1) / 2.0);
}

TEST(Calibration, NamesTheWrongField) {
  const json good = to_json(synthetic_calibration());
  ASSERT_EQ(calibration_error(good), "");
  const auto error_with = [&](const char* pointer, const json& value) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    return calibration_error(bad);
  };
  EXPECT_TRUE(starts_with(error_with("/version", 2), "here.json: version: found 2"));
  EXPECT_TRUE(starts_with(error_with("/baseline", 1), "here.json: top level: found unknown key \"baseline\""));
  EXPECT_TRUE(starts_with(error_with("/ir/k1", 0.1), "here.json: ir: found unknown key \"k1\""));
  EXPECT_TRUE(starts_with(error_with("/ir/k\n1", 0.1), "here.json: ir: found unknown key \"k\\n1\"")) << "one line";
  EXPECT_TRUE(starts_with(error_with("/ir/fx_px", "575"), "here.json: ir.fx_px: found \"575\", expected a number"));
  EXPECT_TRUE(starts_with(error_with("/ir/fx_px", -1), "here.json: ir.fx_px: found -1"));
  EXPECT_TRUE(starts_with(error_with("/rgb/cx_px", std::numeric_limits<double>::quiet_NaN()),
                          "here.json: rgb.cx_px: found a number that is not finite"));
  EXPECT_TRUE(starts_with(error_with("/rgb/width_px", 640.5), "here.json: rgb.width_px: found 640.5"));
  EXPECT_TRUE(starts_with(error_with("/rgb/width_px", 0), "here.json: rgb.width_px: found 0"));
  EXPECT_TRUE(starts_with(error_with("/ir/width_px", 4097), "here.json: ir.width_px: found 4097"));
  EXPECT_EQ(error_with("/ir/width_px", 4096), "") << "4096x480";
  EXPECT_TRUE(starts_with(
      error_with(
          "/ir",
          {{"width_px", 4096}, {"height_px", 4096}, {"fx_px", 500}, {"fy_px", 500}, {"cx_px", 0}, {"cy_px", 0}}),
      "here.json: ir: found 4096x4096 pixels, expected at most 2097152"));
  EXPECT_TRUE(starts_with(error_with("/T_rgb_ir/translation_m", {0.1, 0.2}), "here.json: T_rgb_ir.translation_m"));
  EXPECT_TRUE(starts_with(error_with("/T_rgb_ir/rotation/1/1", 0.9), "here.json: T_rgb_ir.rotation"));
  const json mirrored = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_TRUE(starts_with(error_with("/T_rgb_ir/rotation", mirrored), "here.json: T_rgb_ir.rotation"));
  EXPECT_TRUE(starts_with(error_with("/disparity/a_per_m", 1), "here.json: disparity.b_per_m: found nothing"));
  const auto error_of_line = [&](const json& a, const json& b) {
    return error_with("/disparity", {{"a_per_m", a}, {"b_per_m", b}});
  };
  for (const char* pointer : {"/ir/fx_px", "/rgb/fy_px"})
    for (const double focal_px : {0.0, 1e-300, 1e6, 1e300})
      EXPECT_NE(error_with(pointer, focal_px), "") << pointer << " " << focal_px;
  EXPECT_TRUE(starts_with(error_with("/ir/cx_px", 1e300), "here.json: ir.cx_px: found 1e+300"));
  EXPECT_TRUE(
      starts_with(error_with("/T_rgb_ir/translation_m", {0, 0, 1e300}), "here.json: T_rgb_ir.translation_m"));
  EXPECT_TRUE(starts_with(error_with("/ir/distortion", {{"k1", 1e6}, {"k2", 0}, {"p1", 0}, {"p2", 0}, {"k3", 0}}),
                          "here.json: ir.distortion.k1: found 1000000"));
  EXPECT_EQ(error_of_line(-0.003, 3.33), "");
  EXPECT_TRUE(starts_with(error_of_line(-1e300, 3.33), "here.json: disparity.a_per_m: found -1e+300"));
  EXPECT_TRUE(starts_with(error_of_line(-0.003, 1e300), "here.json: disparity.b_per_m: found 1e+300"));
  EXPECT_TRUE(starts_with(error_of_line(0, 3.33), "here.json: disparity.a_per_m: found 0"));
  EXPECT_TRUE(starts_with(error_of_line(-0.003, 0), "here.json: disparity.b_per_m: found 0"));
  EXPECT_TRUE(starts_with(error_with("/disparity", nullptr), "here.json: disparity: found null"));
  json missing = good;
  missing["rgb"].erase("fy_px");
  EXPECT_TRUE(starts_with(calibration_error(missing), "here.json: rgb.fy_px: found nothing"));
  EXPECT_TRUE(starts_with(calibration_error(json::array()), "here.json: top level: found an array of 0"));
}

TEST(Calibration, RefusesFilesThatAreNotJson) {
  const std::string path = test_folder() + "/not.json";
  for (const char* content : {"", "{\"ir\": NaN}", "[1, 2", "{\"version\": 1e999}", "\xff\xfe"}) {
    write_file(path, content);
    EXPECT_THROW(load_calibration(path), Error) << content;
  }
  std::filesystem::remove(path);
  EXPECT_THROW(load_calibration(path), Error);
}

}  // namespace
}  // namespace glovebench
