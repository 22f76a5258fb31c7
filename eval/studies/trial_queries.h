#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/hand/hand_frame.h"
#include "core/tracker/tracker_config.h"
#include "eval/workbench.h"
#include "render/noise/noise_model.h"
#include "render/rgbd_renderer.h"

namespace glovebench::eval {

/// How trial hands are drawn.
inline constexpr double kTrialAngleNoise_deg = 3.0;  ///< standard deviation of each angle's
/// Hand origins lie in a box around this place on the optical axis with these half edges, m: a hand of 0.19 m,
/// whichever way it is turned, is then in view of both cameras and within the working volume, but for a few.
inline constexpr double kTrialDistance = 0.70;
inline constexpr std::array<double, 3> kTrialReach = {0.12, 0.07, 0.10};

/// A hand between the postures and views of a database: a blend of two different postures (of the one, if there are
/// no more) with noise on every angle, a rotation from the uniform distribution, an origin from the box.
HandFrame draw_trial_hand(const PostureSet& postures, RandomStream& random);

/// The synthetic Kinect and the tracker's stages before the look-up, with the scene of the first subject. Serves
/// one thread at a time; what it sees does not depend on the thread.
class TrialCamera {
 public:
  TrialCamera(Workbench& workbench, const TrackerConfig& config, const render::NoiseConfig& noise);

  /// The labels of the cloud, as the tracker would look them up; empty if it would not. `key` names the noise.
  std::optional<LabelImage> see(const HandFrame& hand, const render::FrameKey& key);

 private:
  TrackerConfig config_;
  render::NoiseConfig noise_;
  std::shared_ptr<const HandModel> model_;
  std::shared_ptr<const ColorTable> table_;
  render::RgbdRenderer renderer_;
};

struct TrialQuery {
  HandFrame hand;
  std::vector<LabelImage> images;  ///< tiny images, one a size
  int redraws = 0;                 ///< hands that were drawn before it and that the tracker would not look up
};
/// `count` trial queries, drawn from `seed` and seen under the paper's noise. Uses the workbench's threads; the
/// result does not depend on their number. Throws Error if the tracker would look up hardly any hand.
std::vector<TrialQuery> make_trial_queries(Workbench& workbench, const TrackerConfig& config,
                                           const PostureSet& postures, std::span<const int> sizes, uint64_t seed,
                                           int count);

}  // namespace glovebench::eval
