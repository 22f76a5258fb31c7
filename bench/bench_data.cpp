#include "bench/bench_data.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/database/database_cache.h"
#include "core/segmentation/color_calibration.h"
#include "render/label_renderer.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::bench {
namespace {

constexpr size_t kFrameStep = 19;  // six to eight frames of each trajectory: open hand, grasp and between
/// Seeds of the movements of each family. The suite `families` judges on 11 to 20.
constexpr uint64_t kTuningSeeds[] = {101, 102}, kJudgingSeeds[] = {11, 12};

Movement movement_of(const trajectories::Trajectory& trajectory) {
  Movement movement{trajectory.name, {}};
  for (size_t f = 0; f < trajectory.frames.size(); f += kFrameStep) movement.frames.push_back(trajectory.frames[f]);
  return movement;
}

const std::string kShareFolder = build_paths::share("");
const std::string kTrajectoryFolder = kShareFolder + "/trajectories/data";

std::optional<BenchData>& storage() {
  static std::optional<BenchData> stored;
  return stored;
}

std::vector<Movement> generated_movements(std::span<const uint64_t> seeds, const Skeleton& skeleton) {
  const auto material = trajectories::load_movement_material(kTrajectoryFolder, skeleton);
  std::vector<Movement> movements;
  for (const trajectories::MovementFamily& family : trajectories::movement_families())
    for (const uint64_t seed : seeds) movements.push_back(movement_of(generate_movement(family, seed, material)));
  return movements;
}

std::vector<Movement> movements_of(FrameSet set, const Skeleton& skeleton) {
  if (set == FrameSet::tuning) return generated_movements(kTuningSeeds, skeleton);
  if (set == FrameSet::judging) return generated_movements(kJudgingSeeds, skeleton);
  std::vector<Movement> movements;
  for (const std::string& name : trajectories::ground_truth_names())
    if (set == FrameSet::paper || name == "Tr4")
      movements.push_back(movement_of(trajectories::source_trajectory(kTrajectoryFolder, name)));
  return movements;
}

/// A color table for the light of the benchmark's frames alone, from true labels.
ColorTable calibrate(const BenchData& data, const std::vector<Movement>& movements) {
  render::RgbdRenderer renderer(data.calibration, data.model, render::SceneConfig{});
  ColorCalibration colors;
  int64_t number = 0;
  for (const Movement& movement : movements) {
    for (const HandFrame& frame : movement.frames) {
      const PosedHand hand = data.model->pose(frame.posture);
      const ColorImage color = renderer.render(hand, frame.T_camera_hand, {}).color;
      colors.add_view(render::add_color_noise(color, render::kColorSigma_gray, {1, "color calibration", number++}),
                      renderer.render_color_labels(hand, frame.T_camera_hand));
    }
  }
  return colors.build();
}

/// Generated frames that the tracker loses are left out.
std::vector<BenchFrame> track_frames(const BenchData& data, const Movement& movement) {
  render::SyntheticKinectConfig config;
  config.sequence = movement.name;
  render::SyntheticKinect kinect(data.calibration, data.model, movement.frames, config);
  const Tracker tracker(data.config, data.calibration, data.model, data.database, data.table);
  std::vector<BenchFrame> frames;
  std::vector<TrackResult> results;
  for (const HandFrame& hand : movement.frames) {
    BenchFrame frame;
    frame.hand = hand;
    frame.device = *kinect.next_frame();
    frame.images = kinect.truth();
    frame.result = tracker.track(frame.device, results);
    results.push_back(frame.result);
    frame.trace = inspect(frame.device, data.calibration, *data.table, data.config);
    if (frame.result.status != TrackStatus::tracked) {
      check(data.settings.frames != FrameSet::paper, "the tracker follows the paper's movements");
      continue;
    }
    frame.square = bounding_square(frame.trace.cloud.labels);
    frame.tiny = make_tiny_images(frame.trace.cloud.labels, frame.square, data.config.lookup.cascade);
    frame.posed = data.model->pose(frame.result.posture_unfiltered);
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Empty if it is not set.
std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string default_cache_folder() {
  if (const std::string chosen = environment("GLOVEBENCH_CACHE"); !chosen.empty()) return chosen;
  if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty()) return cache + "/glovebench";
  if (const std::string home = environment("HOME"); !home.empty()) return home + "/.cache/glovebench";
  return new_temporary_folder();
}

std::string new_temporary_folder() {
  std::string path = (std::filesystem::temp_directory_path() / "glovebench-bench-XXXXXX").string();
  if (::mkdtemp(path.data()) == nullptr) throw Error(path, "folder", std::strerror(errno), "one that can be made");
  return path;
}

DatabaseCache BenchData::cache() const {
  DatabaseCache result;
  result.folder = settings.cache_folder;
  result.renderers = render::label_renderer_factory();
  result.source_hash = render::database_source_hash();
  result.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  result.message = [](const std::string& text) { fmt::print(stderr, "glovebench_bench: {}\n", text); };
  return result;
}

void prepare(const Settings& settings) {
  BenchData data;
  data.settings = settings;
  data.calibration = synthetic_calibration();
  data.config = profile("paper");
  data.model = std::make_shared<HandModel>(HandModel::load(kShareFolder + "/generic-hand-right.glb"));
  data.postures = trajectories::posture_set(kTrajectoryFolder, settings.database);
  data.database =
      std::make_shared<Database>(data.cache().get(data.postures, *data.model, data.config.views, kTinySizes));
  const Skeleton& skeleton = data.model->skeleton();
  data.table = std::make_shared<ColorTable>(calibrate(data, movements_of(settings.colors, skeleton)));
  for (const Movement& movement : movements_of(settings.frames, skeleton))
    std::ranges::move(track_frames(data, movement), std::back_inserter(data.frames));
  storage() = std::move(data);
}

const BenchData& data() {
  check(storage().has_value(), "the data is prepared before the benchmarks run");
  return *storage();
}

std::vector<const BenchFrame*> some_frames() {
  std::vector<const BenchFrame*> frames;
  for (size_t f = 0; f < data().frames.size(); f += 4) frames.push_back(&data().frames[f]);
  return frames;
}

void set_time_each(benchmark::State& state, const std::string& name, size_t count) {
  state.counters[name] = benchmark::Counter(
      static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void set_bytes_touched(benchmark::State& state, const BytesTouched& touched) {
  if (touched.near > 0) state.counters[kNearBytes] = touched.near;
  if (touched.far > 0) state.counters[kFarBytes] = touched.far;
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace glovebench::bench
