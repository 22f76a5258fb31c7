#include "eval/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/adapters/process/process_method.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "eval/run_bytes.h"
#include "eval/terminal.h"
#include "eval/threads.h"
#include "reports/metrics/coverage.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::eval {
namespace {

/// Times of frames and stages: the thread's processor time, or the time that passes while a program answers. Adds
/// up a stage that begins twice in a frame.
class StageTimer {
 public:
  explicit StageTimer(bool waits) : now_ms_(waits ? wall_time_ms : thread_time_ms) {}

  void begin_frame() {
    frame_start_ = now_ms_();
    current_.reset();
    in_this_frame_.fill(std::nullopt);
  }
  void begin(Stage stage) {
    end_stage();
    current_ = stage;
  }
  void end_frame() {
    end_stage();
    frame_ms_.push_back(start_ - frame_start_);
    for (size_t i = 0; i < in_this_frame_.size(); ++i)
      if (in_this_frame_[i]) stage_ms_[i].push_back(*in_this_frame_[i]);
  }
  /// Times of the stages that ever began.
  std::vector<reports::StageTiming> take_stages() {
    std::vector<reports::StageTiming> stages;
    for (const Stage stage : all_values<Stage>()) {
      std::vector<double>& times = stage_ms_[static_cast<size_t>(stage)];
      if (!times.empty()) stages.push_back({std::string(to_string(stage)), std::move(times)});
    }
    return stages;
  }
  std::vector<double> take_frames() { return std::move(frame_ms_); }

 private:
  void end_stage() {
    const double now = now_ms_();
    if (current_) {
      std::optional<double>& time = in_this_frame_[static_cast<size_t>(*current_)];
      time = time.value_or(0) + now - start_;
    }
    start_ = now;
  }

  double (*now_ms_)();
  std::array<std::vector<double>, kCountOf<Stage>> stage_ms_;
  std::vector<double> frame_ms_;
  std::array<std::optional<double>, kCountOf<Stage>> in_this_frame_;  ///< ms
  std::optional<Stage> current_;
  double start_ = 0, frame_start_ = 0;
};

/// True if a tracker could track this frame: most of the visible glove is in the working volume, has enough pixels
/// and does not touch the image border.
bool is_trackable(const render::RgbdImages& images, const TrackerConfig& config) {
  int within = 0, beyond = 0;
  for (int v = 0; v < images.label.height(); ++v) {
    for (int u = 0; u < images.label.width(); ++u) {
      if (images.label(u, v) == 0) continue;
      if (u == 0 || v == 0 || u + 1 == images.label.width() || v + 1 == images.label.height()) return false;
      const float z = images.depth(u, v);
      (z >= config.volume.z_min && z <= config.volume.z_max ? within : beyond) += 1;
    }
  }
  return within >= config.detection.min_pixels && within > 2 * beyond;
}

render::SyntheticKinectConfig kinect_config(const RunSpec& spec) {
  render::SyntheticKinectConfig config;
  config.scene.shader = render::shader_of(spec.subject);
  config.scene.appearance = spec.appearance;
  config.scene.clutter_in_volume = spec.clutter_in_volume;
  config.noise.depth = spec.noise.model;
  config.noise.gain_factor = spec.noise.factor;
  config.seed = spec.seed;
  config.sequence = spec.trajectory->name;
  config.lighting = spec.lighting;
  config.first_frame = spec.frames.first;
  return config;
}

/// True if specs that share images also share device frames.
bool share_noise(const RunSpec& a, const RunSpec& b) { return a.noise == b.noise && a.seed == b.seed; }

/// Of the frame that the device showed last.
double visible_percent_of(const render::SyntheticKinect& kinect, const render::Subject& subject,
                          const HandFrame& truth) {
  return reports::visible_percent(kinect.true_hand(), subject.triangles(), truth.T_camera_hand,
                                  kinect.calibration());
}

Sight sight_of(const render::RgbdImages& images, double visible_percent, const TrackerConfig& config) {
  return {reports::count_patches(images.patch), is_trackable(images, config), visible_percent};
}

/// A run in progress, frame by frame.
class Tracking {
 public:
  Tracking(Workbench& workbench, const RunSpec& spec)
      : kinect_(kinect_config(spec)),
        method_(workbench.make_method(spec.tracker, spec.database)),
        timer_(is_program(spec.tracker.method)) {
    run_.spec = spec;
  }

  const RunSpec& spec() const { return run_.spec; }
  bool drops(int number) const {
    const std::vector<bool>& dropped = run_.spec.dropped;
    return !dropped.empty() && dropped[static_cast<size_t>(number - run_.spec.frames.first)];
  }
  /// Device frame of these images with this run's noise.
  DeviceFrame frame_of(const render::RgbdImages& images, const RgbdCalibration& calibration, int64_t timestamp_us,
                       int number) const {
    return render::make_device_frame(images, calibration, timestamp_us, kinect_.noise,
                                     {kinect_.seed, kinect_.sequence, number});
  }
  void track(const DeviceFrame& frame, const render::RgbdImages& images, double visible_percent) {
    timer_.begin_frame();
    run_.answers.push_back(method_->track(frame, run_.answers, [&](Stage stage) { timer_.begin(stage); }));
    timer_.end_frame();
    run_.seen.push_back(sight_of(images, visible_percent, run_.spec.tracker));
  }
  Run take() {
    run_.stages = timer_.take_stages();
    run_.frame_ms = timer_.take_frames();
    return std::move(run_);
  }

 private:
  Run run_;
  render::SyntheticKinectConfig kinect_;
  std::unique_ptr<Method> method_;
  StageTimer timer_;
};

/// Runs specs that share images; renders each frame once. Calls `frame_done` after each frame of each spec.
std::vector<Run> track_together(Workbench& workbench, std::span<const RunSpec> specs,
                                const std::function<void()>& frame_done) {
  const RunSpec& first = specs.front();
  std::vector<Tracking> trackings;
  for (const RunSpec& spec : specs) {
    check(share_images(first, spec), "runs that are rendered once show the same");
    trackings.emplace_back(workbench, spec);
  }
  const render::Subject subject = workbench.subject(first.subject);
  render::SyntheticKinect kinect = make_kinect(workbench, first);
  int number = first.frames.first;
  for (const HandFrame& truth : frames_of(first)) {
    std::optional<DeviceFrame> frame = kinect.next_frame();
    check(frame.has_value(), "the device plays every frame of the trajectory");
    const double visible_percent = visible_percent_of(kinect, subject, truth);
    const RunSpec* shown = &first;
    for (Tracking& tracking : trackings) {
      if (tracking.drops(number)) {
        frame_done();
        continue;
      }
      if (!share_noise(*shown, tracking.spec())) {
        frame = tracking.frame_of(kinect.truth(), kinect.calibration(), truth.timestamp_us, number);
        shown = &tracking.spec();
      }
      tracking.track(*frame, kinect.truth(), visible_percent);
      frame_done();
    }
    ++number;
  }
  std::vector<Run> runs;
  for (Tracking& tracking : trackings) runs.push_back(tracking.take());
  return runs;
}

/// Loads runs from the store and makes the missing ones. The specs share images.
std::vector<Run> run_group(Workbench& workbench, std::span<const RunSpec> group, const RunStore* store,
                           const std::function<void()>& frame_done) {
  if (!store) return track_together(workbench, group, frame_done);
  std::vector<Run> runs(group.size());
  std::vector<RunSpec> left;
  std::vector<size_t> places;
  std::vector<std::string> keys;
  for (size_t i = 0; i < group.size(); ++i) {
    const std::string key = run_key(workbench, group[i]);
    const std::optional<std::string> bytes = store->load(key);
    if (auto stored = bytes ? run_from_bytes(*bytes, group[i]) : std::nullopt) {
      runs[i] = *std::move(stored);
      for (size_t f = 0; f < frames_of(group[i]).size(); ++f) frame_done();
      continue;
    }
    left.push_back(group[i]);
    places.push_back(i);
    keys.push_back(key);
  }
  if (left.empty()) return runs;
  std::vector<Run> made = track_together(workbench, left, frame_done);
  for (size_t i = 0; i < left.size(); ++i) {
    store->save(keys[i], to_bytes(made[i]));
    runs[places[i]] = std::move(made[i]);
  }
  return runs;
}

/// Beginnings of groups of specs that are rendered once, and the end. Larger groups save rendering, but every
/// thread needs some, and no two of a thread's runs start a program.
std::vector<size_t> group_begins(std::span<const RunSpec> specs, int threads) {
  constexpr size_t kLargest = 24;  // each run of a group keeps a tracker in memory
  const size_t size = std::clamp<size_t>(specs.size() / (2 * static_cast<size_t>(threads)), 1, kLargest);
  std::vector<size_t> begins;
  for (size_t s = 0; s < specs.size(); ++s) {
    const bool joins = !begins.empty() && s - begins.back() < size &&
                       share_images(specs[begins.back()], specs[s]) && !is_program(specs[s].tracker.method);
    if (!joins) begins.push_back(s);
  }
  begins.push_back(specs.size());
  return begins;
}

/// Makes or loads hands, databases and color tables before the threads start, since building a database uses all
/// threads.
void prepare(Workbench& workbench, std::span<const RunSpec> specs) {
  for (const RunSpec& spec : specs) {
    frames_of(spec);
    workbench.subject(spec.subject);
    workbench.database(spec.database);
  }
  for (const RunSpec& spec : specs) workbench.color_table(spec.tracker.segmentation.color_space);
}

}  // namespace

std::span<const HandFrame> frames_of(const RunSpec& spec) {
  const std::span<const HandFrame> all = spec.trajectory->frames;
  const FrameRange& range = spec.frames;
  const auto have = static_cast<int>(all.size());
  const int count = range.count.value_or(have - range.first);
  if (range.first < 0 || count < 1 || range.first > have - count) {
    throw Error(spec.trajectory->name, "frames", fmt::format("{} from {} on", count, range.first),
                fmt::format("frames from 0 to {}", have - 1));
  }
  return all.subspan(range.first, count);
}

reports::ExperimentKey key_of(const RunSpec& spec) {
  const bool is_recorded = spec.trajectory->kind == trajectories::TrajectoryKind::recorded;
  return {
      spec.trajectory->name, spec.database, is_recorded ? reports::TruthKind::recorded : reports::TruthKind::source,
      spec.subject,          spec.noise,    spec.appearance};
}

render::SyntheticKinect make_kinect(Workbench& workbench, const RunSpec& spec) {
  const std::span<const HandFrame> frames = frames_of(spec);
  return render::SyntheticKinect(workbench.calibration(), workbench.subject(spec.subject),
                                 {frames.begin(), frames.end()}, kinect_config(spec));
}

bool share_images(const RunSpec& a, const RunSpec& b) {
  return a.trajectory == b.trajectory && a.subject == b.subject && a.frames == b.frames &&
         a.lighting == b.lighting && a.clutter_in_volume == b.clutter_in_volume && a.appearance == b.appearance;
}

std::vector<Run> execute(Workbench& workbench, std::span<const RunSpec> specs, const RunOptions& options) {
  prepare(workbench, specs);
  if (options.store) options.store->begin();
  size_t frames = 0;
  for (const RunSpec& spec : specs) frames += frames_of(spec).size();
  std::vector<Run> runs(specs.size());
  const std::vector<size_t> begins = group_begins(specs, options.threads);
  Progress progress("replaying", workbench.config().quiet);
  std::atomic<size_t> done{0};
  const auto frame_done = [&] { progress.show(static_cast<double>(++done) / static_cast<double>(frames)); };
  in_parallel(options.threads, begins.size() - 1, [&](size_t g) {
    const std::span<const RunSpec> group = specs.subspan(begins[g], begins[g + 1] - begins[g]);
    std::ranges::move(run_group(workbench, group, options.store, frame_done),
                      runs.begin() + static_cast<std::ptrdiff_t>(begins[g]));
  });
  return runs;
}

std::vector<Sight> see(Workbench& workbench, const RunSpec& spec) {
  const render::Subject subject = workbench.subject(spec.subject);
  render::SyntheticKinect kinect = make_kinect(workbench, spec);
  std::vector<Sight> seen;
  for (const HandFrame& truth : frames_of(spec)) {
    check(kinect.render_next(), "the device plays every frame of the trajectory");
    seen.push_back(sight_of(kinect.truth(), visible_percent_of(kinect, subject, truth), spec.tracker));
  }
  return seen;
}

std::string run_key(Workbench& workbench, const RunSpec& spec) {
  const auto color_table = workbench.color_table(spec.tracker.segmentation.color_space);
  const Eigen::Vector3d& light = spec.lighting.direction_to_light;
  const std::string& method = spec.tracker.method;
  const nlohmann::json content = {
      {"program", is_program(method) ? program_hash(method) : ""},
      {"configuration", to_json(spec.tracker)},
      {"truth", {spec.trajectory->name, trajectories::hash(*spec.trajectory)}},
      {"frames", {spec.frames.first, frames_of(spec).size()}},
      {"dropped", spec.dropped},
      {"noise", {spec.noise.model, spec.noise.factor}},
      {"seed", spec.seed},
      {"lighting",
       {spec.lighting.strength, spec.lighting.temperature_k, spec.lighting.ambient_share,
        std::vector<double>(light.begin(), light.end())}},
      {"clutter_in_volume", spec.clutter_in_volume},
      {"appearance", to_string(spec.appearance)},
      {"subject", {spec.subject, workbench.subject(spec.subject).hash()}},
      {"hand_model", workbench.model()->hash()},
      {"database", {spec.database, workbench.database(spec.database)->content_hash()}},
      {"calibration", to_json(workbench.calibration())},
      {"color_table", hash_bytes(std::as_bytes(std::span(color_table->labels())))},
  };
  return hash_text(content.dump());
}

}  // namespace glovebench::eval
