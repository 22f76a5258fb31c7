#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "core/kinect/device.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {

/// A recording is a folder of libfreenect's fakenect with two more files:
///     INDEX.txt                         file names, one a line, in order of arrival
///     d-SECONDS.MICROS-TICKS.pgm        "P5 640 480 65535", raw disparity, 16-bit little-endian
///     r-SECONDS.MICROS-TICKS.ppm        "P6 640 480 255", RGB
///     a-SECONDS.MICROS-TICKS.dump       accelerometer, ignored
///     calibration.json                  rgbd_calibration.h
///     manifest.json                     core/base/file_set.h; optional
/// SECONDS.MICROS is the arrival by the computer's clock, TICKS the device's time (TickClock). An image's time
/// stamp is its ticks without wraps, nearest to the arrival.

/// Plays a recording, paired by FramePairer.
class RecordingDevice : public Device {
 public:
  /// `calibration` replaces the folder's; fakenect writes none.
  /// Throws: Error if index or calibration is missing or malformed, a file is listed twice, or there is no pair.
  explicit RecordingDevice(const std::string& folder,
                           const std::optional<RgbdCalibration>& calibration = std::nullopt);

  const RgbdCalibration& calibration() const override { return calibration_; }
  /// Throws: FrameError if an image is malformed or differs from the manifest.
  std::optional<DeviceFrame> next_frame() override;

  int frame_count() const { return static_cast<int>(pairs_.size()); }
  int unpaired_depth_count() const { return unpaired_depth_count_; }
  /// Images that were not later than the one before.
  int repeated_count() const { return repeated_count_; }
  /// Calibration or index, if different from the manifest.
  const std::vector<std::string>& changed() const { return changed_; }

 private:
  using Pair = FramePairer<std::string, std::string>::Pair;

  std::string read_text(const std::string& name, uint64_t max_bytes);

  FileSet files_;
  RgbdCalibration calibration_;
  std::vector<std::string> changed_;
  std::vector<Pair> pairs_;
  size_t next_ = 0;
  int unpaired_depth_count_ = 0;
  int repeated_count_ = 0;
};

/// Plays back equal frames if each color image is the nearest to its depth image.
class RecordingWriter {
 public:
  /// Throws: Error if the folder has a recording or cannot be written.
  RecordingWriter(const std::string& folder, const RgbdCalibration& calibration);

  /// Depth time stamps must rise. Equal color time stamps mean the same image.
  /// Throws: Error for wrong time stamps, sizes or disparities.
  void write(const DeviceFrame& frame);
  /// Completes the recording; without it all frames are lost.
  /// Throws: Error without frames.
  void finish();

 private:
  WholeFiles files_;
  std::string folder_;
  RgbdCalibration calibration_;
  std::vector<std::pair<int64_t, std::string>> index_;
  int64_t last_depth_us_ = -1;
  int64_t last_color_us_ = -1;
};

}  // namespace glovebench
