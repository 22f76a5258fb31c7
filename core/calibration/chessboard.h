#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::calibration {

struct Chessboard {
  int columns = 9;        ///< inner corners in a row, >= 3
  int rows = 6;           ///< >= 3, not equal to `columns`
  double square = 0.025;  ///< side, m, > 0

  friend bool operator==(const Chessboard&, const Chessboard&) = default;
};

void check_chessboard(const Chessboard& board, const std::string& where);

/// Inner corners row by row, uv_px. A picture does not tell which end of the board comes first.
using Corners = std::vector<Eigen::Vector2d>;

/// Inner corners in the board's frame, z = 0.
std::vector<Eigen::Vector3d> corners_on(const Chessboard& board);

/// Subpixel accuracy; empty unless the whole board is visible.
std::optional<Corners> find_corners(const Image<uint8_t>& gray, const Chessboard& board);

/// Reverses corners whose rows run opposite to those of `reference`, the same board from a nearby camera.
Corners in_the_order_of(const Corners& reference, Corners corners, const Chessboard& board);

}  // namespace glovebench::calibration
