#pragma once

#include <string>
#include <vector>

#include "core/kinect/device.h"

namespace glovebench {

/// A recording is a folder in the format of libfreenect's fakenect, with `calibration.json` beside the frames:
///
///     INDEX.txt                         one file name a line, in the order of arrival
///     d-SECONDS.MICROS-TICKS.pgm        "P5 640 480 65535", raw disparity, 16-bit little-endian
///     r-SECONDS.MICROS-TICKS.ppm        "P6 640 480 255", RGB
///     a-SECONDS.MICROS-TICKS.dump       accelerometer, ignored
///     calibration.json                  see rgbd_calibration.h
///
/// The time stamp of an image is SECONDS * 1,000,000 + MICROS, with six digits of microseconds, so it returns
/// exactly. TICKS is the device's own clock (60 MHz, 32 bits); written as the low 32 bits of 60 times the time
/// stamp, and not read.

/// Plays a recording. Each depth image is paired with the color image nearest in time (the earlier of two).
/// Depth images with no color image within kMaxPairGap_us are left out and counted.
class RecordingDevice : public Device {
 public:
  static constexpr int64_t kMaxPairGap_us = 50'000;

  /// Throws Error if the index or the calibration is missing or malformed, an image is listed twice or nothing
  /// can be paired. Images are read and checked in next_frame.
  explicit RecordingDevice(const std::string& folder);

  const RgbdCalibration& calibration() const override { return calibration_; }
  /// Throws Error naming the image file and what is wrong with it. The next call goes on with the next frame.
  std::optional<DeviceFrame> next_frame() override;

  int frame_count() const { return static_cast<int>(pairs_.size()); }
  int unpaired_depth_count() const { return unpaired_depth_count_; }

 private:
  struct Entry {
    std::string path;
    int64_t timestamp_us = 0;
  };
  struct Pair {
    Entry depth, color;
  };
  void pair_by_time(const std::vector<Entry>& depths, const std::vector<Entry>& colors);

  RgbdCalibration calibration_;
  std::vector<Pair> pairs_;
  size_t next_ = 0;
  int unpaired_depth_count_ = 0;
};

/// Writes device frames as a recording. What is written is played back equal if each color image is the one
/// nearest in time to its depth image.
class RecordingWriter {
 public:
  /// Throws Error if the folder already holds a recording or cannot be written.
  RecordingWriter(const std::string& folder, const RgbdCalibration& calibration);

  /// Depth time stamps increase; a color time stamp equal to the one before means the same image again. Throws
  /// Error on time stamps that go back or are negative, and on images that no Kinect could give.
  void write(const DeviceFrame& frame);
  /// Writes the index: until then the folder is no recording. Throws Error if no frame was written.
  void finish();

 private:
  std::string folder_;
  RgbdCalibration calibration_;
  std::vector<std::pair<int64_t, std::string>> index_;  ///< time stamp and file name
  int64_t last_depth_us_ = -1;
  int64_t last_color_us_ = -1;
};

}  // namespace glovebench
