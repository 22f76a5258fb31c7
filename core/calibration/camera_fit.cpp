#include "core/calibration/camera_fit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/calibration/opencv_terms.h"

namespace glovebench::calibration {
namespace {

constexpr size_t kFewestViews = 5;
constexpr int kFewestTilted = 3;
constexpr double kTilted_deg = 10;
constexpr double kLargestDeviation = 0.05;  // of the focal length

/// Throws with the reasons for the first pictures that are left out.
void require_views(size_t count, const std::vector<LeftOut>& left_out, const std::string& where) {
  constexpr size_t kMostNamed = 3;
  if (count >= kFewestViews) return;
  std::string found = fmt::format("{}", count);
  for (size_t i = 0; i < std::min(left_out.size(), kMostNamed); ++i)
    found += fmt::format("{}{}: {}", i == 0 ? " (left out: " : "; ", left_out[i].name, left_out[i].reason);
  if (!left_out.empty())
    found += left_out.size() > kMostNamed ? fmt::format("; and {} more)", left_out.size() - kMostNamed) : ")";
  throw Error(where, "views with a whole chessboard", found,
              fmt::format("at least {}, tilted in different ways", kFewestViews));
}

/// True if the board's normal is tilted against the optical axis.
bool is_tilted(const cv::Mat& rotation_vector) {
  cv::Mat R;
  cv::Rodrigues(rotation_vector, R);
  return std::abs(R.at<double>(2, 2)) < std::cos(radians_from_degrees(kTilted_deg));
}

/// Fits all views, also bad ones.
CameraFit fit_all(std::vector<BoardView> views, const Chessboard& board, LensModel lens, cv::Size size) {
  const std::vector<std::vector<cv::Point3f>> on_board(views.size(), board_points(board));
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardView& view : views) seen.push_back(image_points(view.corners));
  cv::Mat K, coefficients, deviations, errors;
  std::vector<cv::Mat> rotations, translations;
  CameraFit fit;
  fit.error_px = cv::calibrateCamera(on_board, seen, size, K, coefficients, rotations, translations, deviations,
                                     cv::noArray(), errors, lens_flags(lens), solver_criteria());
  fit.camera = camera_of(K, size);
  fit.lens = lens_of(coefficients);
  const auto deviation = [&](int i) { return deviations.at<double>(i); };
  fit.deviation = {size.width, size.height, deviation(0), deviation(1), deviation(2), deviation(3)};
  fit.tilted = static_cast<int>(std::ranges::count_if(rotations, is_tilted));
  for (int i = 0; i < errors.rows; ++i) fit.view_errors_px.push_back(errors.at<double>(i));
  fit.views = std::move(views);
  return fit;
}

/// Keeps in `views` only those that fit. Returns whether others were left out.
bool leave_out_misfits(const CameraFit& fit, std::vector<BoardView>& views, std::vector<LeftOut>& left_out) {
  const double limit = misfit_limit(fit.view_errors_px);
  views.clear();
  const size_t before = left_out.size();
  for (size_t i = 0; i < fit.views.size(); ++i)
    if (fit.view_errors_px[i] <= limit)
      views.push_back(fit.views[i]);
    else
      left_out.push_back(misfit(fit.views[i].name, fit.view_errors_px[i], limit));
  return left_out.size() > before;
}

void require_determined(const CameraFit& fit, const std::string& where) {
  if (fit.tilted < kFewestTilted)
    throw Error(where, fmt::format("boards tilted by more than {} degrees", kTilted_deg),
                fmt::format("{}", fit.tilted),
                fmt::format("at least {}: else the focal length cannot be told from the distance", kFewestTilted));
  const PinholeCamera &camera = fit.camera, &deviation = fit.deviation;
  const double share = std::max(deviation.fx / camera.fx, deviation.fy / camera.fy);
  if (!(camera.fx > 0 && camera.fy > 0 && share <= kLargestDeviation))
    throw Error(where, "focal length",
                fmt::format("{:.1f} and {:.1f} px, uncertain by {:.1f} and {:.1f} px", camera.fx, camera.fy,
                            deviation.fx, deviation.fy),
                fmt::format("at most {:.0f}% uncertain: boards tilted by 20 to 50 degrees in all directions",
                            100 * kLargestDeviation));
}

}  // namespace

double misfit_limit(const std::vector<double>& errors_px) {
  constexpr double kTimesMedian = 3, kSmallest_px = 0.5;
  return std::max(kTimesMedian * quantile_of(errors_px, 0.5).value(), kSmallest_px);
}

void require_fit(double error_px, const std::string& where) {
  constexpr double kLargest_px = 2;
  if (!(error_px <= kLargest_px))
    throw Error(
        where, "error of the fit", fmt::format("{:.1f} px", error_px),
        fmt::format("at most {} px: sharp pictures of a flat board, of the size and in the pairs that are said",
                    kLargest_px));
}

LeftOut misfit(const std::string& name, double error_px, double limit_px) {
  return {name, fmt::format("does not fit with the others: {:.2f} px, of at most {:.2f} px", error_px, limit_px)};
}

CameraFit fit_camera(const BoardViews& boards, const Chessboard& board, LensModel lens, const std::string& where) {
  std::vector<BoardView> views = boards.views;
  std::vector<LeftOut> left_out = boards.left_out;
  CameraFit fit;
  do {
    require_views(views.size(), left_out, where);
    fit = fit_all(views, board, lens, cv::Size(boards.width_px, boards.height_px));
  } while (leave_out_misfits(fit, views, left_out));
  require_fit(fit.error_px, where);
  require_determined(fit, where);
  fit.left_out = std::move(left_out);
  return fit;
}

}  // namespace glovebench::calibration
