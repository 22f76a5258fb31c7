#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::calibration {

/// A flat chessboard by its inner corners, where four squares meet.
struct Chessboard {
  int columns = 9;        ///< inner corners in a row, 3 or more
  int rows = 6;           ///< 3 or more, and not as many as columns: a square board has no first row
  double square = 0.025;  ///< side of a square, m, above 0

  friend bool operator==(const Chessboard&, const Chessboard&) = default;
};

/// Throws Error naming `where` and the field if it is none of these.
void check_chessboard(const Chessboard& board, const std::string& where);

/// Inner corners row by row, uv_px. Which corner of the board comes first, one picture cannot tell: the rows may be
/// those of the board turned by half.
using Corners = std::vector<Eigen::Vector2d>;

/// On the board, m, in the order of Corners; z = 0.
std::vector<Eigen::Vector3d> corners_on(const Chessboard& board);

/// All corners of a board that is seen whole, to a fraction of a pixel; nothing if there is none.
std::optional<Corners> find_corners(const Image<uint8_t>& gray, const Chessboard& board);

/// The corners of the same board from a camera beside, in the same order: rows that run the other way are turned.
Corners in_the_order_of(const Corners& reference, Corners corners, const Chessboard& board);

}  // namespace glovebench::calibration
