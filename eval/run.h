#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/tracker/tracker_config.h"
#include "eval/run_store.h"
#include "eval/workbench.h"
#include "render/synthetic_kinect.h"
#include "reports/results.h"
#include "reports/timings.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Consecutive frames of a trajectory.
struct FrameRange {
  int first = 0;             ///< >= 0
  std::optional<int> count;  ///< >= 1; empty: all that follow

  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// One tracker on one trajectory with one noise seed: what is asked for.
struct RunSpec {
  std::shared_ptr<const trajectories::Trajectory> trajectory;  ///< the truth
  FrameRange frames = {};
  int subject = 1;  ///< the hand in front of the camera
  reports::NoiseSetting noise = {};
  uint64_t seed = 1;
  std::string database = {};
  TrackerConfig tracker = {};
  render::Lighting lighting = {};
  bool clutter_in_volume = false;  ///< as render::SceneConfig's
  std::string setting = {};        ///< of a study: its name for this way to run; nothing depends on it
};

/// What the true images of one frame showed.
struct Sight {
  std::array<int, kPatchCount> visible_pixels{};  ///< of each patch, in the IR camera
  bool trackable = false;  ///< enough of the glove is visible within the working volume, and no border cuts it
};

/// What a tracker made of a run. Errors are computed from it afterwards (measured_run.h).
struct Run {
  RunSpec spec;
  std::vector<TrackResult> answers;  ///< one a frame
  std::vector<Sight> seen;           ///< one a frame
  std::vector<reports::StageTiming> stages;
  std::vector<double> frame_ms;  ///< one a frame: all stages
};

/// The frames that are run. Throws Error if the trajectory does not have them.
std::span<const HandFrame> frames_of(const RunSpec& spec);
/// The experiment that a run belongs to: runs that differ in their seed alone.
reports::ExperimentKey key_of(const RunSpec& spec);
/// The Kinect whose frames the tracker is given.
render::SyntheticKinect make_kinect(Workbench& workbench, const RunSpec& spec);
/// Do both show the same hand in the same frames, light and scene, so that they differ in noise, database and
/// configuration alone?
bool share_images(const RunSpec& a, const RunSpec& b);

struct RunOptions {
  int threads = 1;
  RunStore* store = nullptr;  ///< runs that it holds are not done again; each that is done is stored
};
/// Render -> device frame -> track, for each frame of each spec: output i of spec i. The trackers see device frames
/// and calibration only. Runs in any order on that many threads: times depend on their number, since threads share
/// the machine, and nothing else does. Neighbors that share their images are rendered once.
/// Throws Error for a mistake in a spec, before anything is run or stored.
std::vector<Run> execute(Workbench& workbench, std::span<const RunSpec> specs, const RunOptions& options);

/// The key of a run in the store: a hash of all that its outcome depends on beside the program.
std::string run_key(Workbench& workbench, const RunSpec& spec);
/// A run as bytes (CBOR), without its spec; it returns equal to the last bit.
std::string to_bytes(const Run& run);
/// Empty if the bytes are not those of a run.
std::optional<Run> run_from_bytes(const std::string& bytes, const RunSpec& spec);

}  // namespace glovebench::eval
