#pragma once

#include <array>
#include <vector>

#include "core/base/random.h"
#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// An end joint bends by this share of its middle joint.
inline constexpr double kEndJointShare = 2.0 / 3.0;

/// Departures from a gesture, each of RMS 1 degree. End joints follow by kEndJointShare. The wrist is still.
const std::vector<Posture>& variation_modes();

/// A sum of sinusoids between two frequencies; mean 0, RMS 1.
class SmoothNoise {
 public:
  SmoothNoise(RandomStream& random, double low_hz, double high_hz);
  double at(double time_s) const;

 private:
  struct Wave {
    double frequency_hz;
    double phase;
  };
  std::array<Wave, 4> waves_;
};

}  // namespace glovebench::trajectories
