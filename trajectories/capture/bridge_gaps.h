#pragma once

#include <array>
#include <vector>

#include "trajectories/capture/capture_hand.h"
#include "trajectories/capture/fit_frame.h"

namespace glovebench::trajectories {

struct Bridged {
  std::vector<HandState> states;
  std::vector<std::array<bool, kAngleCount>> angles;  ///< filled ones by frame
  std::vector<bool> poses;                            ///< filled ones
  std::array<bool, kAngleCount> never_shown = {};
  int angle_gaps = 0;  ///< gaps of angles that other frames show
};

/// Interpolates what frames do not show, constant at the ends. An angle that no frame shows is 0, or kEndJointShare
/// of the middle joint. `shown`, `times_s`: by frame.
Bridged bridge_gaps(const std::vector<HandState>& states, const std::vector<Observability>& shown,
                    const std::vector<double>& times_s);

}  // namespace glovebench::trajectories
