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

struct FrameRange {
  int first = 0;             ///< >= 0
  std::optional<int> count;  ///< >= 1; empty: all others

  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// One tracker, one trajectory, one noise seed.
struct RunSpec {
  std::shared_ptr<const trajectories::Trajectory> trajectory;
  FrameRange frames = {};
  int subject = 1;
  reports::NoiseSetting noise = {};
  uint64_t seed = 1;
  std::string database = {};
  TrackerConfig tracker = {};
  render::Lighting lighting = {};
  bool clutter_in_volume = false;
  Appearance appearance = Appearance::glove;
  std::string setting = {};        ///< a study's setting or a movement's family
  std::vector<bool> dropped = {};  ///< by frame: hidden from the tracker; empty: none
};

/// Measured on true images and surface.
struct Sight {
  std::array<int, kPatchCount> visible_pixels{};  ///< by patch, IR camera
  bool trackable = false;                         ///< enough glove in the working volume, none cut by the border
  double visible_percent = 0;                     ///< see reports/metrics/coverage.h
};

/// Results by frame that the tracker got.
struct Run {
  RunSpec spec;
  std::vector<TrackResult> answers;
  std::vector<Sight> seen;
  std::vector<reports::StageTiming> stages;
  std::vector<double> frame_ms;  ///< all stages
};

/// Throws: Error if the trajectory lacks them.
std::span<const HandFrame> frames_of(const RunSpec& spec);
/// The seed does not change it.
reports::ExperimentKey key_of(const RunSpec& spec);
render::SyntheticKinect make_kinect(Workbench& workbench, const RunSpec& spec);
/// True if hand, frames, light and scene are the same.
bool share_images(const RunSpec& a, const RunSpec& b);

struct RunOptions {
  int threads = 1;
  RunStore* store = nullptr;  ///< of finished runs; null: none
};
/// Renders, adds noise and tracks, in the order of `specs`. Trackers get only device frames and calibration.
/// `threads` change only times. Successive specs with the same images are rendered once. Throws: Error for a wrong
/// spec, before any work.
std::vector<Run> execute(Workbench& workbench, std::span<const RunSpec> specs, const RunOptions& options);

/// By frame. Renders without noise.
std::vector<Sight> see(Workbench& workbench, const RunSpec& spec);

/// Hash of all inputs except the program.
std::string run_key(Workbench& workbench, const RunSpec& spec);

}  // namespace glovebench::eval
