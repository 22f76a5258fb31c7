#include "core/calibration/stereo_fit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/calibration/camera_fit.h"
#include "core/calibration/opencv_terms.h"

namespace glovebench::calibration {
namespace {

constexpr size_t kFewestPairs = 5;
/// Limits for two cameras of one device. A larger transform means wrong pairs.
constexpr double kFarthestApart = 0.5;  // m
constexpr double kMostTurned_deg = 45;

/// The board in the same place before both cameras.
struct Pair {
  std::string name;
  Corners ir, rgb;
};

std::vector<Pair> pair_up(const CameraFit& ir, const CameraFit& rgb, const Chessboard& board) {
  std::vector<Pair> pairs;
  for (const BoardView& view : ir.views) {
    const auto same = std::find_if(rgb.views.begin(), rgb.views.end(),
                                   [&](const BoardView& other) { return other.name == view.name; });
    if (same != rgb.views.end())
      pairs.push_back({view.name, view.corners, in_the_order_of(view.corners, same->corners, board)});
  }
  return pairs;
}

void require_pairs(const std::vector<Pair>& pairs) {
  if (pairs.size() < kFewestPairs)
    throw Error("IR and RGB views", "views of the same name that fit", fmt::format("{}", pairs.size()),
                fmt::format("at least {}: the same name for the same place of the board", kFewestPairs));
}

Eigen::Isometry3d isometry_of(const cv::Mat& R, const cv::Mat& t) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) T.linear()(row, column) = R.at<double>(row, column);
    T.translation()[row] = t.at<double>(row);
  }
  // Removes rounding errors of OpenCV's rotation.
  T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return T;
}

Eigen::Isometry3d board_pose(const PinholeCamera& camera, const LensDistortion& lens, const Corners& corners,
                             const Chessboard& board) {
  cv::Mat rotation, R, t;
  cv::solvePnP(board_points(board), image_points(corners), matrix_of(camera), coefficients_of(lens), rotation, t,
               false, cv::SOLVEPNP_ITERATIVE);
  cv::Rodrigues(rotation, R);
  return isometry_of(R, t);
}

/// The cameras and the transform that fit all these pairs, and the errors they leave. Fitted together, the cameras'
/// centers, which one camera alone can hardly tell from a turn, are known several times better beside each other.
void fit_pairs(StereoFit& fit, const std::vector<Pair>& pairs, const Chessboard& board, LensModel lens) {
  const std::vector<std::vector<cv::Point3f>> on_board(pairs.size(), board_points(board));
  std::vector<std::vector<cv::Point2f>> in_ir, in_rgb;
  for (const Pair& pair : pairs) {
    in_ir.push_back(image_points(pair.ir));
    in_rgb.push_back(image_points(pair.rgb));
  }
  const cv::Size ir_size(fit.ir.camera.width, fit.ir.camera.height);
  const cv::Size rgb_size(fit.rgb.camera.width, fit.rgb.camera.height);
  cv::Mat K_ir = matrix_of(fit.ir.camera), K_rgb = matrix_of(fit.rgb.camera);
  cv::Mat lens_ir = coefficients_of(fit.ir.lens), lens_rgb = coefficients_of(fit.rgb.lens), R, t, E, F, errors;
  // OpenCV's R and t take points of the first camera, here IR, to the second.
  fit.error_px = cv::stereoCalibrate(on_board, in_ir, in_rgb, K_ir, lens_ir, K_rgb, lens_rgb, ir_size, R, t, E, F,
                                     errors, cv::CALIB_USE_INTRINSIC_GUESS | lens_flags(lens), solver_criteria());
  fit.pair_errors_px.clear();
  for (int i = 0; i < errors.rows; ++i)
    fit.pair_errors_px.push_back(std::hypot(errors.at<double>(i, 0), errors.at<double>(i, 1)) /
                                 std::numbers::sqrt2);
  fit.calibration = {.ir = camera_of(K_ir, ir_size),
                     .rgb = camera_of(K_rgb, rgb_size),
                     .T_rgb_ir = isometry_of(R, t),
                     .ir_lens = lens_of(lens_ir),
                     .rgb_lens = lens_of(lens_rgb)};
}

/// Removes pairs that do not fit. Returns whether there were any.
bool leave_out_misfits(StereoFit& fit, std::vector<Pair>& pairs) {
  const double limit = misfit_limit(fit.pair_errors_px);
  std::vector<Pair> fitting;
  for (size_t i = 0; i < pairs.size(); ++i)
    if (fit.pair_errors_px[i] <= limit)
      fitting.push_back(std::move(pairs[i]));
    else
      fit.left_out.push_back(misfit(pairs[i].name, fit.pair_errors_px[i], limit));
  const bool some = fitting.size() < pairs.size();
  pairs = std::move(fitting);
  return some;
}

/// Standard errors of the transform, from the transforms of single pairs.
void add_standard_errors(StereoFit& fit, const std::vector<Pair>& pairs, const Chessboard& board) {
  const RgbdCalibration& c = fit.calibration;
  double translation = 0, rotation = 0;
  for (const Pair& pair : pairs) {
    const Eigen::Isometry3d T_rgb_board = board_pose(c.rgb, c.rgb_lens, pair.rgb, board);
    const Eigen::Isometry3d T_rgb_ir = T_rgb_board * board_pose(c.ir, c.ir_lens, pair.ir, board).inverse();
    const Eigen::Isometry3d apart = T_rgb_ir * c.T_rgb_ir.inverse();
    translation += (T_rgb_ir.translation() - c.T_rgb_ir.translation()).squaredNorm();
    const double angle = Eigen::AngleAxisd(apart.linear()).angle();
    rotation += angle * angle;
  }
  const double n = static_cast<double>(pairs.size());
  fit.translation_error = std::sqrt(translation / n / (n - 1));
  fit.rotation_error = std::sqrt(rotation / n / (n - 1));
}

void require_one_device(const Eigen::Isometry3d& T_rgb_ir) {
  const double apart = T_rgb_ir.translation().norm();
  const double turned_deg = degrees_from_radians(Eigen::AngleAxisd(T_rgb_ir.linear()).angle());
  if (!(apart <= kFarthestApart && turned_deg <= kMostTurned_deg))
    throw Error("IR and RGB views", "transform between the cameras",
                fmt::format("{:.3f} m and {:.1f} degrees", apart, turned_deg),
                fmt::format("at most {} m and {} degrees: pairs of the same place of the board", kFarthestApart,
                            kMostTurned_deg));
}

using nlohmann::json;

json errors_json(const std::string& name, double error_px) { return {{"name", name}, {"error_px", error_px}}; }

json left_out_json(const std::vector<LeftOut>& left_out) {
  json entries = json::array();
  for (const LeftOut& entry : left_out) entries.push_back({{"name", entry.name}, {"reason", entry.reason}});
  return entries;
}

json camera_json(const CameraFit& fit) {
  json views = json::array();
  for (size_t i = 0; i < fit.views.size(); ++i)
    views.push_back(errors_json(fit.views[i].name, fit.view_errors_px[i]));
  return {{"error_px", fit.error_px},
          {"deviation",
           {{"fx_px", fit.deviation.fx},
            {"fy_px", fit.deviation.fy},
            {"cx_px", fit.deviation.cx},
            {"cy_px", fit.deviation.cy}}},
          {"views", views},
          {"left_out", left_out_json(fit.left_out)}};
}

std::string camera_row(const char* name, const PinholeCamera& c, const LensDistortion& lens, const CameraFit& fit) {
  const PinholeCamera& d = fit.deviation;
  return fmt::format(
      "| {} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.4f}, {:.4f}, "
      "{:.4f}, {:.4f}, {:.4f} | {} | {:.3f} |\n",
      name, c.fx, d.fx, c.fy, d.fy, c.cx, d.cx, c.cy, d.cy, lens.k1, lens.k2, lens.p1, lens.p2, lens.k3,
      fit.views.size(), fit.error_px);
}

std::string left_out_lines(const char* of, const std::vector<LeftOut>& left_out) {
  std::string lines;
  for (const LeftOut& entry : left_out) lines += fmt::format("left out, {} {}: {}\n", of, entry.name, entry.reason);
  return lines;
}

}  // namespace

StereoFit fit_stereo(const BoardViews& ir, const BoardViews& rgb, const Chessboard& board, LensModel lens) {
  StereoFit fit;
  fit.ir = fit_camera(ir, board, lens, "IR views");
  fit.rgb = fit_camera(rgb, board, lens, "RGB views");
  std::vector<Pair> pairs = pair_up(fit.ir, fit.rgb, board);
  do {
    require_pairs(pairs);
    fit_pairs(fit, pairs, board, lens);
  } while (leave_out_misfits(fit, pairs));
  require_fit(fit.error_px, "IR and RGB views");
  require_one_device(fit.calibration.T_rgb_ir);
  add_standard_errors(fit, pairs, board);
  for (const Pair& pair : pairs) fit.pairs.push_back(pair.name);
  return fit;
}

json report_json(const StereoFit& fit, const Chessboard& board) {
  json pairs = json::array();
  for (size_t i = 0; i < fit.pairs.size(); ++i) pairs.push_back(errors_json(fit.pairs[i], fit.pair_errors_px[i]));
  return {{"version", 1},
          {"chessboard", {{"columns", board.columns}, {"rows", board.rows}, {"square_m", board.square}}},
          {"ir", camera_json(fit.ir)},
          {"rgb", camera_json(fit.rgb)},
          {"stereo",
           {{"error_px", fit.error_px},
            {"translation_error_m", fit.translation_error},
            {"rotation_error_deg", degrees_from_radians(fit.rotation_error)},
            {"pairs", pairs},
            {"left_out", left_out_json(fit.left_out)}}}};
}

std::string report_text(const StereoFit& fit) {
  const Eigen::Vector3d t_mm = 1000 * fit.calibration.T_rgb_ir.translation();
  const double angle = Eigen::AngleAxisd(fit.calibration.T_rgb_ir.linear()).angle();
  return "| camera | fx px | fy px | cx px | cy px | k1, k2, p1, p2, k3 | views | error px |\n"
         "| --- | --- | --- | --- | --- | --- | ---: | ---: |\n" +
         camera_row("IR", fit.calibration.ir, fit.calibration.ir_lens, fit.ir) +
         camera_row("RGB", fit.calibration.rgb, fit.calibration.rgb_lens, fit.rgb) +
         fmt::format(
             "\nIR to RGB: {:.2f}, {:.2f}, {:.2f} mm (± {:.2f}), turned by {:.3f} degrees (± {:.3f}); {} pairs, "
             "error {:.3f} px\n",
             t_mm.x(), t_mm.y(), t_mm.z(), 1000 * fit.translation_error, degrees_from_radians(angle),
             degrees_from_radians(fit.rotation_error), fit.pairs.size(), fit.error_px) +
         left_out_lines("IR", fit.ir.left_out) + left_out_lines("RGB", fit.rgb.left_out) +
         left_out_lines("pair", fit.left_out);
}

}  // namespace glovebench::calibration
