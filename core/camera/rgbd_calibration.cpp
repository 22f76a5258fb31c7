#include "core/camera/rgbd_calibration.h"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

using nlohmann::json;

constexpr int kCalibrationVersion = 1;
constexpr double kOrthonormalTolerance = 1e-6;  // calibration tools print at least seven digits

/// A place in a file, for error messages: "calibration.json: ir.fx_px: found ..., expected ...".
struct Place {
  std::string where;
  std::string field;

  Place operator/(std::string_view key) const {
    return {where, field.empty() ? std::string(key) : field + "." + std::string(key)};
  }
  Error error(const std::string& found, const std::string& expected) const {
    return Error(where, field.empty() ? "content" : field, found, expected);
  }
};

void require_keys(const json& object, const Place& place, std::initializer_list<std::string_view> keys,
                  std::string_view optional_key = "") {
  if (!object.is_object()) throw place.error(excerpt(object), "an object");
  for (std::string_view key : keys)
    if (!object.contains(std::string(key))) throw(place / key).error("nothing", "a value");
  for (const auto& [key, value] : object.items())
    if (key != optional_key && std::find(keys.begin(), keys.end(), key) == keys.end())
      throw(place / printable(key)).error("an unknown key", "only the documented keys");
}

double read_number(const json& value, const Place& place) {
  if (!value.is_number()) throw place.error(excerpt(value), "a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw place.error("a number that is not finite", "a finite number");
  return number;
}

double read_positive(const json& value, const Place& place) {
  const double number = read_number(value, place);
  if (number <= 0) throw place.error(excerpt(value), "a number above 0");
  return number;
}

int read_side(const json& value, const Place& place) {
  const bool in_range = value.is_number_integer() && value >= 1 && value <= kMostSide_px;
  if (!in_range) throw place.error(excerpt(value), "a whole number of 1.." + std::to_string(kMostSide_px));
  return value.get<int>();
}

Eigen::Vector3d read_vector(const json& value, const Place& place) {
  if (!value.is_array() || value.size() != 3) throw place.error(excerpt(value), "an array of 3 numbers");
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = read_number(value[i], place / std::to_string(i));
  return vector;
}

Eigen::Matrix3d read_rotation(const json& value, const Place& place) {
  if (!value.is_array() || value.size() != 3) throw place.error(excerpt(value), "an array of 3 rows");
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row) R.row(row) = read_vector(value[row], place / std::to_string(row));
  const double deviation = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= kOrthonormalTolerance) || R.determinant() < 0)
    throw place.error(R.determinant() < 0 ? "a left-handed one" : "one that is off by " + std::to_string(deviation),
                      "an orthonormal, right-handed matrix");
  return R;
}

PinholeCamera read_camera(const json& value, const Place& place) {
  require_keys(value, place, {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}, "distortion");
  const int width = read_side(value["width_px"], place / "width_px"),
            height = read_side(value["height_px"], place / "height_px");
  if (width * height > kMostPixels)
    throw place.error(std::to_string(width) + "x" + std::to_string(height) + " pixels",
                      "at most " + std::to_string(kMostPixels) + " pixels, such as 1920x1080");
  return {.width = width,
          .height = height,
          .fx = read_positive(value["fx_px"], place / "fx_px"),
          .fy = read_positive(value["fy_px"], place / "fy_px"),
          .cx = read_number(value["cx_px"], place / "cx_px"),
          .cy = read_number(value["cy_px"], place / "cy_px")};
}

/// That of a camera which was read.
LensDistortion read_lens(const json& camera, const Place& place) {
  if (!camera.contains("distortion")) return {};
  const json& value = camera["distortion"];
  const Place lens = place / "distortion";
  require_keys(value, lens, {"k1", "k2", "p1", "p2", "k3"});
  const auto read = [&](const char* key) { return read_number(value[key], lens / key); };
  return {.k1 = read("k1"), .k2 = read("k2"), .p1 = read("p1"), .p2 = read("p2"), .k3 = read("k3")};
}

DisparityLine read_disparity(const json& value, const Place& place) {
  require_keys(value, place, {"a_per_m", "b_per_m"});
  const double a = read_number(value["a_per_m"], place / "a_per_m");
  if (a >= 0) throw(place / "a_per_m").error(value["a_per_m"].dump(), "a number below 0");
  return {a, read_positive(value["b_per_m"], place / "b_per_m")};
}

json camera_to_json(const PinholeCamera& camera, const LensDistortion& lens) {
  json written = {{"width_px", camera.width}, {"height_px", camera.height}, {"fx_px", camera.fx},
                  {"fy_px", camera.fy},       {"cx_px", camera.cx},         {"cy_px", camera.cy}};
  if (!lens.is_none())
    written["distortion"] = {{"k1", lens.k1}, {"k2", lens.k2}, {"p1", lens.p1}, {"p2", lens.p2}, {"k3", lens.k3}};
  return written;
}

json vector_to_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

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
  const Place root{where, ""};
  require_keys(json, root, {"version", "ir", "rgb", "T_rgb_ir"}, "disparity");
  if (json["version"] != kCalibrationVersion)
    throw(root / "version").error(json["version"].dump(), std::to_string(kCalibrationVersion));
  const auto& T = json["T_rgb_ir"];
  const Place T_place = root / "T_rgb_ir";
  require_keys(T, T_place, {"rotation", "translation_m"});

  RgbdCalibration calibration;
  calibration.ir = read_camera(json["ir"], root / "ir");
  calibration.rgb = read_camera(json["rgb"], root / "rgb");
  calibration.ir_lens = read_lens(json["ir"], root / "ir");
  calibration.rgb_lens = read_lens(json["rgb"], root / "rgb");
  calibration.T_rgb_ir.linear() = read_rotation(T["rotation"], T_place / "rotation");
  calibration.T_rgb_ir.translation() = read_vector(T["translation_m"], T_place / "translation_m");
  if (json.contains("disparity")) calibration.disparity = read_disparity(json["disparity"], root / "disparity");
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

std::string calibration_text(const RgbdCalibration& calibration) {
  return to_json(calibration).dump(2) + "\n";
}

void save_calibration(const RgbdCalibration& calibration, const std::string& path) {
  write_file(path, calibration_text(calibration));
}

}  // namespace glovebench
