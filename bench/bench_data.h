#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/database/database_cache.h"
#include "core/hand/hand_model.h"
#include "core/hand/posture.h"
#include "core/segmentation/color_table.h"
#include "core/tracker/tracker.h"
#include "render/synthetic_kinect.h"

namespace glovebench::bench {

struct Movement {
  std::string name;
  std::vector<HandFrame> frames;
};

/// Every 19th frame of these movements.
enum class FrameSet {
  paper,    ///< the five source trajectories
  tr4,      ///< one of them
  tuning,   ///< generated: two of each family, to choose constants
  judging,  ///< generated: two others
};
constexpr auto names_of(FrameSet) { return std::to_array<std::string_view>({"paper", "Tr4", "tuning", "judging"}); }

/// GLOVEBENCH_CACHE, the user's or a new temporary folder.
/// Throws: Error.
std::string default_cache_folder();
/// Private to this user.
/// Throws: Error.
std::string new_temporary_folder();

struct Settings {
  std::string cache_folder;
  std::string database = "DB_20_postures";
  FrameSet frames = FrameSet::paper;
  FrameSet colors = FrameSet::paper;  ///< of the color table
};

struct BenchFrame {
  HandFrame hand;
  render::RgbdImages images;  ///< without noise
  DeviceFrame device;
  FrameTrace trace;
  Square square;
  TinyImages tiny;
  PosedHand posed;  ///< in the posture found
  TrackResult result;
};

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

/// Makes `data`.
/// Throws: Error.
void prepare(const Settings& settings);
const BenchData& data();
/// Every fourth frame, for plain implementations that take long.
std::vector<const BenchFrame*> some_frames();

/// Returns the first result of this name, so that repetitions check an answer once.
template <typename Compute>
auto once(const std::string& name, const Compute& compute) {
  static std::map<std::string, decltype(compute())> results;
  const auto found = results.find(name);
  return found != results.end() ? found->second : results.emplace(name, compute()).first->second;
}

/// For a library that the build lacks.
inline constexpr const char* kMissing = "missing";

/// Adds a counter: time per item.
void set_time_each(benchmark::State& state, const std::string& name, size_t count);

/// Times `run` on all items, and adds the time for one of them as counter `name`.
template <typename Items, typename Run>
void time_each(benchmark::State& state, const std::string& name, const Items& items, const Run& run) {
  for (auto _ : state)
    for (const auto& item : items) benchmark::DoNotOptimize(run(item));
  set_time_each(state, name, items.size());
}

/// Minimum bytes per item.
struct BytesTouched {
  double near = 0;  ///< in caches; `far`: in memory
  double far = 0;
};
inline constexpr const char *kNearBytes = "near_bytes", *kFarBytes = "far_bytes";
void set_bytes_touched(benchmark::State& state, const BytesTouched& touched);

/// Bytes.
double peak_memory();

}  // namespace glovebench::bench
