#pragma once

#include <array>
#include <vector>

#include "core/base/random.h"
#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// The end joint of a finger bends this share of its middle joint: one tendon moves both.
inline constexpr double kEndJointShare = 2.0 / 3.0;

/// The ways in which a hand departs from a gesture: fingers bend together, spread, trade knuckle for middle joint,
/// or one finger moves with its neighbors following. Each mode has a root mean square of one degree over the 22
/// angles; end joints follow by kEndJointShare; the wrist keeps still.
const std::vector<Posture>& variation_modes();

/// A smooth random function of time: a few sinusoids with frequencies between `low_hz` and `high_hz`; mean 0, root
/// mean square 1 in the long run.
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
