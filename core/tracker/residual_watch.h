#pragma once

#include "core/tracker/track_result.h"

namespace glovebench {

/// Notices when a hand does not fit the person: the points lie farther from it than noise explains. For methods
/// that fit pose and posture to the points (those that know their certainty); others are off for other reasons.
class ResidualWatch {
 public:
  void add(const TrackResult& result);
  /// The mean residual, m, if it asks for a calibration of the hand; empty if it does not or cannot be told yet.
  std::optional<double> alarming_residual() const;

 private:
  int frames_ = 0;
  double sum_ = 0;
};

}  // namespace glovebench
