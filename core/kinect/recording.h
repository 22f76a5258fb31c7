#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "core/kinect/device.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {

/// A recording is a folder in the format of libfreenect's fakenect, with `calibration.json` beside the frames:
///
///     INDEX.txt                         one file name a line, in the order of arrival
///     d-SECONDS.MICROS-TICKS.pgm        "P5 640 480 65535", raw disparity, 16-bit little-endian
///     r-SECONDS.MICROS-TICKS.ppm        "P6 640 480 255", RGB
///     a-SECONDS.MICROS-TICKS.dump       accelerometer, ignored
///     calibration.json                  see rgbd_calibration.h
///     manifest.json                     the hash of each file (core/base/file_set.h), if glovebench recorded it
///
/// SECONDS.MICROS is when an image arrived, by the computer's clock, with six digits of microseconds. TICKS is when
/// it was taken, by the device's own clock (60 MHz, 32 bits), which comes around every 71.6 s. The time stamp of an
/// image is that of its ticks, in the round that fits its arrival best, so recordings may pause for as long as they
/// like. Written are both from one time stamp, so it returns exactly.

/// Plays a recording, paired as FramePairer does. Depth images with no color image near them are left out and
/// counted, and so are images with the time stamp of the one before.
class RecordingDevice : public Device {
 public:
  /// Throws Error if the index or the calibration is missing or malformed, a file is listed twice or nothing can
  /// be paired. Images are read and checked in next_frame. With `calibration` that of the folder is not read: a
  /// recording of fakenect's own has none.
  explicit RecordingDevice(const std::string& folder,
                           const std::optional<RgbdCalibration>& calibration = std::nullopt);

  const RgbdCalibration& calibration() const override { return calibration_; }
  /// Throws FrameError naming the image file and what is wrong with it: also if the manifest has another hash for
  /// it. An image that the manifest does not name was added by hand, and is read as it is.
  std::optional<DeviceFrame> next_frame() override;

  int frame_count() const { return static_cast<int>(pairs_.size()); }
  int unpaired_depth_count() const { return unpaired_depth_count_; }
  /// Images with the time stamp of the one before of their kind.
  int repeated_count() const { return repeated_count_; }
  /// The calibration and the index, if somebody changed them since they were recorded.
  const std::vector<std::string>& changed() const { return changed_; }

 private:
  using Pair = FramePairer<std::string, std::string>::Pair;  ///< of names of files

  std::string read_text(const std::string& name, uint64_t max_bytes);

  FileSet files_;
  RgbdCalibration calibration_;
  std::vector<std::string> changed_;
  std::vector<Pair> pairs_;
  size_t next_ = 0;
  int unpaired_depth_count_ = 0;
  int repeated_count_ = 0;
};

/// Writes device frames as a recording, a set of files (core/base/file_set.h). What is written is played back equal
/// if each color image is the one nearest in time to its depth image.
class RecordingWriter {
 public:
  /// Throws Error if the folder already holds a recording, or cannot be written.
  RecordingWriter(const std::string& folder, const RgbdCalibration& calibration);

  /// Depth time stamps increase; a color time stamp equal to the one before means the same image again. Throws
  /// Error on time stamps that go back or are negative, and on images that no Kinect could give.
  void write(const DeviceFrame& frame);
  /// Until then the folder is no recording: an error, a full disk or a kill leaves none of its frames. So this is
  /// for frames that can be made again, not for a live camera. Throws Error if no frame was written.
  void finish();

 private:
  WholeFiles files_;
  std::string folder_;
  RgbdCalibration calibration_;
  std::vector<std::pair<int64_t, std::string>> index_;  ///< time stamp and file name
  int64_t last_depth_us_ = -1;
  int64_t last_color_us_ = -1;
};

}  // namespace glovebench
