#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/hand/posture.h"
#include "eval/run.h"

namespace glovebench::eval {

/// A movement that becomes files.
struct Dataset {
  std::string folder;
  std::string name;  ///< of a file that holds all frames
  RgbdCalibration calibration;
  std::shared_ptr<const HandModel> tracker_hand;  ///< of estimates
  std::string readme;                             ///< see dataset_readme
};

/// A rendered frame; poses and truth are those of the IR camera.
struct DatasetFrame {
  int number = 0;
  const DeviceFrame& images;
  const HandFrame& truth;
  render::SyntheticKinect& kinect;
  std::optional<HandFrame> estimate;  ///< empty: lost or not tracked
};

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Throws: Error.
  virtual void add(const DatasetFrame& frame) = 0;
  /// Completes the dataset. Otherwise all frames are lost.
  /// Throws: Error.
  virtual void finish() = 0;
};

/// eval/frame_formats/X_frames.cpp defines `FrameFormat X_frames()`.
struct FrameFormat {
  std::string_view name;
  std::string_view description;
  std::string_view conventions;  ///< lines of README.txt: files, units, frames
  bool has_estimates;
  /// Throws: Error.
  std::unique_ptr<FrameWriter> (*make)(const Dataset& dataset);
};
std::span<const FrameFormat> frame_formats();
/// Throws: Error.
const FrameFormat& find_frame_format(std::string_view name);

/// README.txt: origin, conventions, license.
std::string dataset_readme(const FrameFormat& format, const RunSpec& spec);

/// Empty if the hand is lost. An empty function: nothing tracks.
using Estimator = std::function<std::optional<HandFrame>(const DeviceFrame& images, int number)>;
/// Renders and writes a run's frames.
/// Throws: Error.
void write_frames(Workbench& workbench, const RunSpec& spec, const Estimator& estimate, const FrameFormat& format,
                  const Dataset& dataset);

/// Writes FOLDER/EXPERIMENT.mcap of each experiment's first seed: rendered frames, truth, and estimates of
/// FOLDER/estimates/.
/// Throws: Error.
void write_run_mcaps(Workbench& workbench, std::span<const RunSpec> specs, const std::string& folder);

}  // namespace glovebench::eval
