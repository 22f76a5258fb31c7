#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "core/database/database_cache.h"
#include "core/hand/hand_model.h"
#include "core/segmentation/color_table.h"
#include "core/tracker/tracker.h"
#include "render/synthetic_kinect.h"

namespace glovebench::bench {

/// GLOVEBENCH_CACHE, else the user's cache folder, else a new folder in the temporary directory: none that somebody
/// else could have filled. Throws Error.
std::string default_cache_folder();
/// A new folder in the temporary directory, only for this user. Throws Error.
std::string new_temporary_folder();

struct Settings {
  std::string cache_folder;
  std::string database = "DB_20_postures";
  std::string frames = "tuned";  ///< "tuned" or "held-out" (movements.h)
  std::string colors = "same";   ///< the color table is made with true labels of the "same" poses, or of those of
                                 ///< the "other" frames
};

/// One frame of a movement and what each stage of the tracker made of it.
struct BenchFrame {
  HandFrame hand;             ///< the truth
  render::RgbdImages images;  ///< without noise
  DeviceFrame device;
  FrameTrace trace;
  Square square;    ///< around the glove's labels
  TinyImages tiny;  ///< of the default cascade
  PosedHand posed;  ///< in the looked-up posture
  TrackResult result;
};

/// What all benchmarks share.
struct BenchData {
  Settings settings;
  RgbdCalibration calibration;
  TrackerConfig config;
  std::shared_ptr<const HandModel> model;
  PostureSet postures;
  std::shared_ptr<const Database> database;
  std::shared_ptr<const ColorTable> table;
  std::vector<BenchFrame> frames;

  DatabaseCache cache() const;
};

/// Renders the frames, tracks them and loads (or builds) the database, once, before any benchmark. Throws Error.
void prepare(const Settings& settings);
/// What `prepare` made.
const BenchData& data();

/// The error of a benchmark whose library this build lacks. It is shown, and no failure.
inline constexpr const char* kMissing = "missing";

/// Says that each iteration did something with all `count` of these: adds the time for one as a counter.
void set_time_each(benchmark::State& state, const std::string& name, size_t count);

/// The bytes that one frame (or another item) makes a stage read and write at least.
struct BytesTouched {
  double near = 0;  ///< in the core's own caches: what was touched a moment ago
  double far = 0;   ///< behind them
};
/// The counters that say so.
inline constexpr const char *kNearBytes = "near_bytes", *kFarBytes = "far_bytes";
void set_bytes_touched(benchmark::State& state, const BytesTouched& touched);

/// The peak of the process's resident memory so far, bytes.
double peak_memory();

}  // namespace glovebench::bench
