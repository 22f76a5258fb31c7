#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/chessboard.h"

namespace glovebench::calibration {

struct BoardView {
  std::string name;  ///< file name without ending, or number in the recording
  Corners corners;
};
struct LeftOut {
  std::string name;
  std::string reason;
};

/// The board as one camera saw it.
struct BoardViews {
  int width_px = 0, height_px = 0;
  std::vector<BoardView> views;
  std::vector<LeftOut> left_out;
  std::vector<std::string> changed = {};  ///< recorded files that were changed later
};

/// Called before each picture; `done` counts those before it.
using Looked = std::function<void(size_t done, size_t count)>;

/// Decodes an image file to gray.
/// Throws: Error naming `path` if it is no image or exceeds kMostPixels.
Image<uint8_t> decode_gray(std::string_view content, const std::string& path);

/// Finds the board in a folder of images, or in at most `most` color images, evenly spaced, of `fakenect:FOLDER`.
/// Throws: Error if there is no picture or their sizes differ.
BoardViews find_boards(const std::string& source, const Chessboard& board, size_t most, const Looked& looked = {});

}  // namespace glovebench::calibration
