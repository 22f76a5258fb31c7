#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/hand/posture.h"
#include "core/tracker/tracker_config.h"
#include "eval/workbench.h"
#include "render/noise/noise_model.h"
#include "render/rgbd_renderer.h"

namespace glovebench::eval {

inline constexpr double kTrialAngleNoise_deg = 3.0;  ///< standard deviation
/// Center (on the optical axis) and half edges of the box of hand origins, m.
inline constexpr double kTrialDistance = 0.70;
inline constexpr std::array<double, 3> kTrialReach = {0.12, 0.07, 0.10};

/// A blend of two postures (or the only one) with noise, a uniform rotation and an origin in the box.
HandFrame draw_trial_hand(const PostureSet& postures, RandomStream& random);

/// A synthetic Kinect with subject 1, and the stages before the look-up. Not thread-safe.
class TrialCamera {
 public:
  TrialCamera(Workbench& workbench, const TrackerConfig& config, const render::NoiseConfig& noise);

  /// The label image for the look-up, if any. `key` selects the noise.
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
  std::vector<LabelImage> images;  ///< by size
  int redraws = 0;                 ///< rejected hands before it
};
/// Queries under the paper's noise. Threads do not change them.
/// Throws: Error if hardly any hand can be looked up.
std::vector<TrialQuery> make_trial_queries(Workbench& workbench, const TrackerConfig& config,
                                           const PostureSet& postures, std::span<const int> sizes, uint64_t seed,
                                           int count);

}  // namespace glovebench::eval
