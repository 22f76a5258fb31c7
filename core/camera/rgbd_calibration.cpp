#include "core/camera/rgbd_calibration.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

using nlohmann::json;

constexpr int kCalibrationVersion = 1;
constexpr double kOrthonormalTolerance = 1e-6;  // calibration tools print at least seven digits

/// Beyond every camera's: such a number is damage, and every frame would be lost.
constexpr double kLeastFocal_px = 1, kMost_px = 1e5, kMostCoefficient = 1000, kMostTranslation_m = 10;
constexpr double kLeastA_per_m = 1e-6, kMostA_per_m = 1, kMostB_per_m = 1000;

double read_within(const JsonCursor& json, double least, double most) {
  json.number();
  return json.number(least, most);
}

Eigen::Matrix3d read_rotation(const JsonCursor& json) {
  const JsonItems rows = json.items(3);
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row) R.row(row) = rows[row].vector3();
  const double deviation = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= kOrthonormalTolerance) || R.determinant() < 0)
    json.fail(R.determinant() < 0 ? "a left-handed one" : "one that is off by " + std::to_string(deviation),
              "an orthonormal, right-handed matrix");
  return R;
}

PinholeCamera read_camera(const JsonCursor& json) {
  json.expect_keys({"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}, {"distortion"});
  const auto width = static_cast<int>(json["width_px"].integer(1, kMostSide_px)),
             height = static_cast<int>(json["height_px"].integer(1, kMostSide_px));
  if (width * height > kMostPixels)
    json.fail(std::to_string(width) + "x" + std::to_string(height) + " pixels",
              "at most " + std::to_string(kMostPixels) + " pixels, such as 1920x1080");
  return {.width = width,
          .height = height,
          .fx = read_within(json["fx_px"], kLeastFocal_px, kMost_px),
          .fy = read_within(json["fy_px"], kLeastFocal_px, kMost_px),
          .cx = read_within(json["cx_px"], -kMost_px, kMost_px),
          .cy = read_within(json["cy_px"], -kMost_px, kMost_px)};
}

LensDistortion read_lens(const JsonCursor& camera) {
  if (!camera.has("distortion")) return {};
  const JsonCursor lens = camera["distortion"];
  lens.expect_keys({"k1", "k2", "p1", "p2", "k3"});
  const auto read = [&](const char* key) { return read_within(lens[key], -kMostCoefficient, kMostCoefficient); };
  return {.k1 = read("k1"), .k2 = read("k2"), .p1 = read("p1"), .p2 = read("p2"), .k3 = read("k3")};
}

DisparityLine read_disparity(const JsonCursor& json) {
  json.expect_keys({"a_per_m", "b_per_m"});
  return {read_within(json["a_per_m"], -kMostA_per_m, -kLeastA_per_m),
          read_within(json["b_per_m"], kLeastA_per_m, kMostB_per_m)};
}

json camera_to_json(const PinholeCamera& camera, const LensDistortion& lens) {
  json written = {{"width_px", camera.width}, {"height_px", camera.height}, {"fx_px", camera.fx},
                  {"fy_px", camera.fy},       {"cx_px", camera.cx},         {"cy_px", camera.cy}};
  if (!lens.is_none())
    written["distortion"] = {{"k1", lens.k1}, {"k2", lens.k2}, {"p1", lens.p1}, {"p2", lens.p2}, {"k3", lens.k3}};
  return written;
}

json vector_to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

RgbdCalibration synthetic_calibration() {
  RgbdCalibration calibration;
  calibration.ir = {.width = 640, .height = 480, .fx = 575.816, .fy = 575.816, .cx = 321.3, .cy = 238.6};
  calibration.rgb = {.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 317.8, .cy = 241.9};
  // The RGB camera sits 24 mm to the right of the IR camera (towards the projector), so points move left.
  const double angle = radians_from_degrees(0.7);
  calibration.T_rgb_ir.linear() =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(0.5, 0.8, -0.3).normalized()).toRotationMatrix();
  calibration.T_rgb_ir.translation() = Eigen::Vector3d(-0.99, 0.03, -0.05).normalized() * 0.024;
  return calibration;
}

RgbdCalibration nominal_kinect_calibration() {
  RgbdCalibration calibration;
  calibration.ir = {.width = 640, .height = 480, .fx = 575.816, .fy = 575.816, .cx = 319.5, .cy = 239.5};
  calibration.rgb = {.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5};
  calibration.T_rgb_ir.translation() = Eigen::Vector3d(-0.025, 0, 0);
  return calibration;
}

RgbdCalibration calibration_from_json(const json& json, const std::string& where) {
  const JsonCursor root(json, where);
  root.expect_keys({"version", "ir", "rgb", "T_rgb_ir"}, {"disparity"});
  root["version"].integer(kCalibrationVersion, kCalibrationVersion);
  const JsonCursor T = root["T_rgb_ir"];
  T.expect_keys({"rotation", "translation_m"});

  RgbdCalibration calibration;
  calibration.ir = read_camera(root["ir"]);
  calibration.rgb = read_camera(root["rgb"]);
  calibration.ir_lens = read_lens(root["ir"]);
  calibration.rgb_lens = read_lens(root["rgb"]);
  calibration.T_rgb_ir.linear() = read_rotation(T["rotation"]);
  calibration.T_rgb_ir.translation() = T["translation_m"].vector3(kMostTranslation_m);
  if (root.has("disparity")) calibration.disparity = read_disparity(root["disparity"]);
  return calibration;
}

json to_json(const RgbdCalibration& calibration) {
  const Eigen::Matrix3d R = calibration.T_rgb_ir.linear();
  json rotation = json::array();
  for (int row = 0; row < 3; ++row) rotation.push_back(vector_to_json(R.row(row)));
  json written = {
      {"version", kCalibrationVersion},
      {"ir", camera_to_json(calibration.ir, calibration.ir_lens)},
      {"rgb", camera_to_json(calibration.rgb, calibration.rgb_lens)},
      {"T_rgb_ir",
       {{"rotation", rotation}, {"translation_m", vector_to_json(calibration.T_rgb_ir.translation())}}}};
  if (const auto& line = calibration.disparity)
    written["disparity"] = {{"a_per_m", line->a_per_m}, {"b_per_m", line->b_per_m}};
  return written;
}

RgbdCalibration calibration_from_text(std::string_view text, const std::string& where) {
  return calibration_from_json(parse_json(text, where), where);
}

RgbdCalibration load_calibration(const std::string& path) {
  return calibration_from_text(read_file(path, kLargestCalibration), path);
}

std::string calibration_text(const RgbdCalibration& calibration) { return to_json(calibration).dump(2) + "\n"; }

void save_calibration(const RgbdCalibration& calibration, const std::string& path) {
  write_file(path, calibration_text(calibration));
}

}  // namespace glovebench
