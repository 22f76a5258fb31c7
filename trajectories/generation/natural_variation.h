#pragma once

#include <array>
#include <vector>

#include "core/base/random.h"
#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// The ways in which a hand departs from a gesture: fingers bend together, spread, trade knuckle for middle joint,
/// or one finger moves with its neighbors following. Each mode has a root mean square of one degree over the 22
/// angles; the end joint of a finger bends two thirds as far as its middle joint; the wrist keeps still.
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
