#pragma once

#include <string>

namespace glovebench::reports {

/// Pictures of all frames of a curve in one image. A frame has two tiles, one above the other: the true hand, and
/// the difference of the depth images of estimate and truth. Frame i of the sheet is in column i % columns of the
/// pair of tile rows i / columns.
struct FrameSheet {
  std::string figure;  ///< "figure5"
  std::string image;   ///< the bytes of a JPEG (or PNG) file
  int columns = 1;
  int tile_width = 0;   ///< px
  int tile_height = 0;  ///< px
  int first_frame = 0;  ///< its number in the trajectory
  int frames = 0;
};

/// Depth differences of that much and more have the strongest color of a sheet.
inline constexpr double kSheetDifferenceMm = 20;

}  // namespace glovebench::reports
