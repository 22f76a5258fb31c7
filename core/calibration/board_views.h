#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::calibration {

struct Chessboard {
  int columns = 9;        ///< inner corners per row, >= 3
  int rows = 6;           ///< >= 3, not equal to `columns`
  double square = 0.025;  ///< side, m, > 0

  friend bool operator==(const Chessboard&, const Chessboard&) = default;
};

/// Throws: Error.
void check_chessboard(const Chessboard& board, const std::string& where);

/// Inner corners row by row, uv_px, from either end.
using Corners = std::vector<Eigen::Vector2d>;

/// In the board's frame, m, z = 0.
std::vector<Eigen::Vector3d> corners_on(const Chessboard& board);

/// To subpixels. Empty unless the whole board is visible.
std::optional<Corners> find_corners(const Image<uint8_t>& gray, const Chessboard& board);

/// Reverses corners if their rows run opposite to `reference`, the same board from a nearby camera.
Corners in_the_order_of(const Corners& reference, Corners corners, const Chessboard& board);

struct BoardView {
  std::string name;  ///< file name without ending, or number
  Corners corners;
};
struct LeftOut {
  std::string name;
  std::string reason;
};

struct BoardViews {
  int width_px = 0, height_px = 0;
  std::vector<BoardView> views;
  std::vector<LeftOut> left_out;
  std::vector<std::string> changed = {};  ///< files that differ from the manifest
};

/// Called before each picture. `done`: number of earlier ones.
using Looked = std::function<void(size_t done, size_t count)>;

/// Searches a folder of images, or up to `most` evenly spaced color images of `fakenect:FOLDER`.
/// Throws: Error without pictures, or if sizes differ.
BoardViews find_boards(const std::string& source, const Chessboard& board, size_t most, const Looked& looked = {});

}  // namespace glovebench::calibration
