#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/tracker/tracker.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// Tracks one hand; remembers only the previous results.
class Method {
 public:
  virtual ~Method() = default;
  /// As Tracker::track.
  virtual TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                            const StageObserver& observe) = 0;
  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous = {}) {
    return track(frame, previous, unobserved);
  }
};

struct MethodInputs {
  TrackerConfig config;
  RgbdCalibration calibration;
  std::shared_ptr<const HandModel> model;
  std::shared_ptr<const Database> database;
  std::shared_ptr<const ColorTable> table;
  ViewRendererFactory renderers = {};  ///< renders to compare; may be empty
};

/// core/methods/X_method.cpp defines `MethodEntry X_method()`.
struct MethodEntry {
  std::string_view name;
  std::string_view description;
  /// Throws: Error as Tracker.
  std::unique_ptr<Method> (*make)(const MethodInputs& inputs);
  bool sees_depth = true;  ///< looks a hand up in a `Sighting`, if no earlier frame shows it
};
std::span<const MethodEntry> methods();
/// Throws: Error for an unknown name.
const MethodEntry& find_method(std::string_view name);

}  // namespace glovebench
