#include "core/calibration/chessboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace glovebench::calibration {
namespace {

constexpr int kFewest = 3, kMost = 100;
constexpr double kLargestSquare = 1.0;  // m: what is larger was meant in millimeters

/// Half the window in which a corner is refined: under half a square, so that it holds no other corner.
int window_of(const std::vector<cv::Point2f>& corners) {
  float nearest = INFINITY;
  for (size_t i = 1; i < corners.size(); ++i)
    nearest = std::min(nearest, static_cast<float>(cv::norm(corners[i] - corners[i - 1])));
  return std::clamp(static_cast<int>(0.4f * nearest), 2, 11);
}

Eigen::Vector2d along_first_row(const Corners& corners, const Chessboard& board) {
  return corners[board.columns - 1] - corners[0];
}

}  // namespace

void check_chessboard(const Chessboard& board, const std::string& where) {
  const auto check_count = [&](const char* field, int count) {
    if (count < kFewest || count > kMost)
      throw Error(where, field, fmt::format("{}", count), fmt::format("{} to {} inner corners", kFewest, kMost));
  };
  check_count("columns", board.columns);
  check_count("rows", board.rows);
  if (board.columns == board.rows)
    throw Error(where, "columns and rows", fmt::format("{} each", board.rows),
                "different numbers: else rows and columns cannot be told apart");
  if (!(board.square > 0 && board.square <= kLargestSquare))
    throw Error(where, "square", fmt::format("{} m", board.square),
                fmt::format("above 0, at most {} m", kLargestSquare));
}

std::vector<Eigen::Vector3d> corners_on(const Chessboard& board) {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      corners.emplace_back(column * board.square, row * board.square, 0);
  return corners;
}

std::optional<Corners> find_corners(const Image<uint8_t>& gray, const Chessboard& board) {
  const cv::Mat image(gray.height(), gray.width(), CV_8UC1, const_cast<uint8_t*>(gray.data()));
  std::vector<cv::Point2f> found;
  const cv::Size size(board.columns, board.rows);
  if (!cv::findChessboardCorners(image, size, found, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return std::nullopt;
  const int window = window_of(found);
  cv::cornerSubPix(image, found, cv::Size(window, window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3));
  Corners corners;
  for (const cv::Point2f& corner : found) corners.emplace_back(corner.x, corner.y);
  return corners;
}

Corners in_the_order_of(const Corners& reference, Corners corners, const Chessboard& board) {
  if (along_first_row(reference, board).dot(along_first_row(corners, board)) < 0)
    std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace glovebench::calibration
