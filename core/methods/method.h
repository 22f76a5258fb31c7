#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/methods/method_names.h"
#include "core/tracker/tracker.h"

namespace glovebench {

/// A way to follow one hand: from device frames to posture and pose. Frames are given in time order.
class Method {
 public:
  virtual ~Method() = default;
  /// The answer for one frame. `observe` is told each stage when it begins.
  virtual TrackResult track(const DeviceFrame& frame, const StageObserver& observe = unobserved) = 0;
};

/// What a method may be made of; it sees nothing else.
struct MethodInputs {
  TrackerConfig config;
  RgbdCalibration calibration;
  std::shared_ptr<const HandModel> model;
  std::shared_ptr<const Database> database;
  std::shared_ptr<const ColorTable> table;
};

/// A method: X_method.cpp in this folder defines `MethodEntry X_method()`.
struct MethodEntry {
  std::string_view name;         ///< X
  std::string_view description;  ///< one line
  /// Throws Error as Tracker does.
  std::unique_ptr<Method> (*make)(const MethodInputs& inputs);
};
/// All of this folder, sorted by name.
std::span<const MethodEntry> methods();
/// Throws Error listing the known ones.
const MethodEntry& find_method(std::string_view name);

}  // namespace glovebench
