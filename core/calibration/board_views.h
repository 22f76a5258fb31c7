#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/chessboard.h"

namespace glovebench::calibration {

/// A picture in which the board was found.
struct BoardView {
  std::string name;  ///< the same for a pose of the board in both cameras
  Corners corners;
};
/// A picture that is of no use, and why.
struct LeftOut {
  std::string name;
  std::string reason;
};

/// The board as one camera saw it.
struct BoardViews {
  int width_px = 0, height_px = 0;  ///< of all pictures
  std::vector<BoardView> views;     ///< by name
  std::vector<LeftOut> left_out;
  std::vector<std::string> changed = {};  ///< files of a recording, changed since it was recorded
};

/// Says how many of how many pictures were looked at.
using Looked = std::function<void(size_t done, size_t count)>;

/// The gray image that a file's content is. Throws Error naming `path` if it is none, or has over kMostPixels.
Image<uint8_t> decode_gray(std::string_view content, const std::string& path);

/// Looks for the board in the pictures of a source: a folder of image files (PNG, JPEG, PGM, PPM, TIFF, BMP; 8 or
/// 16 bits), each named by its file name without ending, or fakenect:FOLDER, a recording's color images, each named
/// by its number from 0; of more than `most`, that many evenly over the recording. Pictures that cannot be read, or
/// show no whole board, or are larger than kMostPixels, are left out. Throws Error if there is no picture, or they
/// are of different sizes.
BoardViews find_boards(const std::string& source, const Chessboard& board, size_t most, const Looked& looked = {});

}  // namespace glovebench::calibration
