#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/chessboard.h"

namespace glovebench::calibration {

struct BoardView {
  std::string name;  ///< without ending, or number in the recording
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
  std::vector<std::string> changed = {};  ///< recorded files that differ from the manifest
};

/// Called before each picture, with `done` before it.
using Looked = std::function<void(size_t done, size_t count)>;

/// Decodes an image file to gray.
/// Throws: Error naming `path` if it is no image or exceeds kMostPixels.
Image<uint8_t> decode_gray(std::string_view content, const std::string& path);

/// Finds the board in a folder of images, or in at most `most` evenly spaced color images of `fakenect:FOLDER`.
/// Throws: Error without pictures, or if sizes differ.
BoardViews find_boards(const std::string& source, const Chessboard& board, size_t most, const Looked& looked = {});

}  // namespace glovebench::calibration
