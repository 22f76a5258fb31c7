#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image.h"

namespace glovebench::eval {

class PictureSink {
 public:
  virtual ~PictureSink() = default;
  /// Numbers and times must rise.
  /// Throws: Error.
  virtual void add(int number, int64_t timestamp_us, const ColorImage& picture) = 0;
  /// Throws: Error.
  virtual void finish() {}
};

/// A folder of PNG files, FOLDER/000042.png, or a video of 30 frames/s (*.mp4) by ffmpeg, which is
/// FILE.partial.mp4 until `finish`. Size in px.
/// Throws: Error unless the folder is new or empty, for another ending, or without ffmpeg.
std::unique_ptr<PictureSink> open_picture_sink(const std::string& path, int width, int height);

}  // namespace glovebench::eval
