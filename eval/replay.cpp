#include "eval/replay.h"

#include <fmt/format.h>

#include <map>

#include "core/base/error.h"
#include "eval/thread_time.h"

namespace glovebench::eval {
namespace {

/// Collects the processor times of a tracker's frames and of their stages as the tracker names them; a stage that
/// is named twice in a frame has the sum.
class StageTimer {
 public:
  void begin(std::string_view stage) {
    const double now = thread_time_ms();
    if (current_ < 0) frame_start_ = now;
    if (current_ >= 0) in_this_frame_[current_] += now - start_;
    if (stage.empty()) end_frame(now);
    current_ = stage.empty() ? -1 : index_of(stage);
    if (current_ >= 0) in_this_frame_.try_emplace(current_, 0.0);
    start_ = now;
  }
  std::vector<reports::StageTiming> take_stages() { return std::move(stages_); }
  std::vector<double> take_frames() { return std::move(frame_ms_); }

 private:
  void end_frame(double now) {
    for (const auto& [stage, time] : in_this_frame_) stages_[stage].frame_ms.push_back(time);
    in_this_frame_.clear();
    frame_ms_.push_back(now - frame_start_);
  }
  int index_of(std::string_view stage) {
    for (size_t i = 0; i < stages_.size(); ++i) {
      if (stages_[i].stage == stage) return static_cast<int>(i);
    }
    stages_.push_back({std::string(stage), {}});
    return static_cast<int>(stages_.size()) - 1;
  }

  std::vector<reports::StageTiming> stages_;
  std::vector<double> frame_ms_;
  std::map<int, double> in_this_frame_;  ///< of each stage, ms
  int current_ = -1;
  double start_ = 0, frame_start_ = 0;
};

/// Could a tracker be asked for this frame? Most of the visible glove lies within the working volume, is enough to
/// be a hand, and does not reach the image border.
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

reports::FrameTruth truth_of(const trajectories::TrajectoryFrame& frame, const render::Subject& subject,
                             const render::RgbdImages& images) {
  reports::FrameTruth truth;
  truth.posture = frame.posture;
  truth.T_camera_hand = frame.T_camera_hand;
  truth.T_hand_joint = subject.joints(frame.posture);
  truth.visible_pixels = reports::count_patches(images.patch);
  return truth;
}

render::SyntheticKinectConfig kinect_config(const Replay& replay) {
  render::SyntheticKinectConfig config;
  config.scene.shader = render::shader_of(replay.subject);
  config.scene.clutter_in_volume = replay.clutter_in_volume;
  config.noise.depth = replay.noise.model;
  config.noise.gain_factor = replay.noise.factor;
  config.seed = replay.seed;
  config.sequence = replay.truth->name;
  config.lighting = replay.lighting;
  config.first_frame = replay.range.first;
  return config;
}

/// Of replays that share their images: do they share their device frames, too?
bool share_noise(const Replay& a, const Replay& b) {
  return a.noise == b.noise && a.seed == b.seed;
}

/// The trackers of one replay and what they made so far.
class Pass {
 public:
  Pass(Workbench& workbench, const Replay& replay)
      : replay_(&replay), kinect_(kinect_config(replay)), model_(workbench.model()) {
    for (const std::string& database : replay.databases) {
      methods_.push_back(workbench.make_method(replay.tracker, database));
      tracked_.push_back({database, {}, {}, {}, {}});
    }
    timers_.resize(methods_.size());
  }

  const Replay& replay() const { return *replay_; }
  /// The device frame of these images, under this replay's noise.
  DeviceFrame frame_of(const render::RgbdImages& images, const RgbdCalibration& calibration, int64_t timestamp_us,
                       int number) const {
    return render::make_device_frame(images, calibration, timestamp_us, kinect_.noise,
                                     {kinect_.seed, kinect_.sequence, number});
  }
  void track(const DeviceFrame& frame, const reports::FrameTruth& truth, int number) {
    for (size_t t = 0; t < methods_.size(); ++t) {
      const TrackResult result =
          methods_[t]->track(frame, [&](std::string_view stage) { timers_[t].begin(stage); });
      tracked_[t].errors.push_back(reports::measure_frame(number, result, truth, *model_));
      tracked_[t].results.push_back(result);
    }
  }
  std::vector<TrackedReplay> take() {
    for (size_t t = 0; t < tracked_.size(); ++t) {
      tracked_[t].stages = timers_[t].take_stages();
      tracked_[t].frame_ms = timers_[t].take_frames();
    }
    return std::move(tracked_);
  }

 private:
  const Replay* replay_;
  render::SyntheticKinectConfig kinect_;
  std::shared_ptr<const HandModel> model_;
  std::vector<std::unique_ptr<Method>> methods_;
  std::vector<TrackedReplay> tracked_;
  std::vector<StageTimer> timers_;
};

}  // namespace

std::span<const trajectories::TrajectoryFrame> frames_of(const Replay& replay) {
  const std::span<const trajectories::TrajectoryFrame> all = replay.truth->frames;
  const FrameRange& range = replay.range;
  const auto have = static_cast<int>(all.size());
  const int count = range.count.value_or(have - range.first);
  if (range.first < 0 || count < 1 || range.first > have - count) {
    throw Error(replay.truth->name, "frames", fmt::format("{} from {} on", count, range.first),
                fmt::format("some of 0 to {}", have - 1));
  }
  return all.subspan(range.first, count);
}

bool share_images(const Replay& a, const Replay& b) {
  return a.truth == b.truth && a.subject == b.subject && a.range == b.range && a.lighting == b.lighting &&
         a.clutter_in_volume == b.clutter_in_volume;
}

render::SyntheticKinect make_kinect(Workbench& workbench, const Replay& replay) {
  std::vector<render::HandFrame> frames;
  for (const trajectories::TrajectoryFrame& frame : frames_of(replay)) {
    frames.push_back({frame.timestamp_us, frame.posture, frame.T_camera_hand});
  }
  return render::SyntheticKinect(workbench.calibration(), workbench.subject(replay.subject), std::move(frames),
                                 kinect_config(replay));
}

std::vector<std::vector<TrackedReplay>> replay_together(Workbench& workbench, std::span<const Replay> replays,
                                                        const std::function<void()>& frame_done) {
  const Replay& first = replays.front();
  std::vector<Pass> passes;
  for (const Replay& replay : replays) {
    check(share_images(first, replay), "replays that are rendered once show the same");
    passes.emplace_back(workbench, replay);
  }
  const render::Subject subject = workbench.subject(first.subject);

  render::SyntheticKinect kinect = make_kinect(workbench, first);
  int number = first.range.first;
  for (const trajectories::TrajectoryFrame& true_frame : frames_of(first)) {
    std::optional<DeviceFrame> frame = kinect.next_frame();
    check(frame.has_value(), "the device plays every frame of the trajectory");
    const render::RgbdImages& images = kinect.truth();
    reports::FrameTruth truth = truth_of(true_frame, subject, images);
    const Replay* shown = &first;
    for (Pass& pass : passes) {
      if (!share_noise(*shown, pass.replay())) {
        frame = pass.frame_of(images, kinect.calibration(), true_frame.timestamp_us, number);
        shown = &pass.replay();
      }
      truth.trackable = is_trackable(images, pass.replay().tracker);
      pass.track(*frame, truth, number);
      if (frame_done) frame_done();
    }
    ++number;
  }
  std::vector<std::vector<TrackedReplay>> tracked;
  for (Pass& pass : passes) tracked.push_back(pass.take());
  return tracked;
}

std::vector<TrackedReplay> replay(Workbench& workbench, const Replay& replay,
                                  const std::function<void()>& frame_done) {
  return replay_together(workbench, {&replay, 1}, frame_done).front();
}

}  // namespace glovebench::eval
