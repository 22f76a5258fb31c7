#pragma once

#include <array>
#include <vector>

#include "trajectories/capture/capture_hand.h"
#include "trajectories/capture/fit_frame.h"

namespace glovebench::trajectories {

/// The states of a sequence after its gaps were filled.
struct Bridged {
  std::vector<HandState> states;
  std::vector<std::array<bool, kAngleCount>> angles;  ///< those of each frame that were filled
  std::vector<bool> poses;                            ///< of each frame, whether its pose was not shown
  std::array<bool, kAngleCount> never_shown = {};
  int angle_gaps = 0;  ///< runs of frames without an angle that is shown elsewhere
};

/// Fills in what the points of a frame do not show: an angle or the pose goes evenly from the last frame that shows
/// it to the next; before the first and after the last it rests. An angle that no frame shows is 0 degrees, an end
/// joint two thirds of its middle joint. `shown` and `times_s`: one for each frame.
Bridged bridge_gaps(const std::vector<HandState>& states, const std::vector<Observability>& shown,
                    const std::vector<double>& times_s);

}  // namespace glovebench::trajectories
