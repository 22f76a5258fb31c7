#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/tracker/tracker_config.h"
#include "eval/workbench.h"
#include "render/synthetic_kinect.h"
#include "reports/metrics/measure_frame.h"
#include "reports/timings.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Consecutive frames of a trajectory.
struct FrameRange {
  int first = 0;             ///< >= 0
  std::optional<int> count;  ///< >= 1; empty: all that follow

  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// One pass over a trajectory: rendered once, tracked with one configuration against each of the databases.
struct Replay {
  std::shared_ptr<const trajectories::Trajectory> truth;
  int subject = 1;  ///< the hand in front of the camera
  reports::NoiseSetting noise;
  uint64_t seed = 1;
  std::vector<std::string> databases;
  FrameRange range = {};
  TrackerConfig tracker = {};
  render::Lighting lighting = {};
  bool clutter_in_volume = false;  ///< as render::SceneConfig's
};
/// The frames of the truth that are replayed. Throws Error if the trajectory does not have them.
std::span<const HandFrame> frames_of(const Replay& replay);

/// What one tracker made of a replay.
struct TrackedReplay {
  std::string database;
  std::vector<TrackResult> results;          ///< one a frame
  std::vector<reports::FrameErrors> errors;  ///< one a frame
  std::vector<reports::StageTiming> stages;
  std::vector<double> frame_ms;  ///< one a frame: all stages
};

/// The Kinect that plays a trajectory: what `replay` gives to the tracker.
render::SyntheticKinect make_kinect(Workbench& workbench, const Replay& replay);

/// Replays ground truth through the whole tracker: render -> device frame -> track -> measure. The trackers see
/// device frames and calibration only. `frame_done` is called after each frame.
std::vector<TrackedReplay> replay(Workbench& workbench, const Replay& replay,
                                  const std::function<void()>& frame_done = {});

/// Do they show the same hand in the same frames, light and scene, so that they differ in noise, databases and
/// configuration alone?
bool share_images(const Replay& a, const Replay& b);
/// The same for replays that share their images, which are rendered once: an output for each, equal to its own
/// replay's. `frame_done` is called after each frame of each.
std::vector<std::vector<TrackedReplay>> replay_together(Workbench& workbench, std::span<const Replay> replays,
                                                        const std::function<void()>& frame_done = {});

}  // namespace glovebench::eval
