#include "eval/studies/trial_queries.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <atomic>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/tracker/sighting.h"
#include "eval/terminal.h"
#include "eval/threads.h"
#include "render/synthetic_kinect.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kSequence = "trial queries";

TrialQuery make_trial_query(TrialCamera& camera, const PostureSet& postures, std::span<const int> sizes,
                            uint64_t seed, int number) {
  constexpr int kMaxDraws = 100;  // rarely more than two with the paper's configuration
  RandomStream random(seed, kSequence, number, "hand");
  for (int redraws = 0; redraws < kMaxDraws; ++redraws) {
    TrialQuery query{draw_trial_hand(postures, random), {}, redraws};
    const std::optional<LabelImage> labels = camera.see(query.hand, {seed, kSequence, number});
    if (!labels) continue;
    const Square square = bounding_square(*labels);
    for (const int size : sizes) query.images.push_back(make_tiny_image(*labels, square, size));
    return query;
  }
  throw Error("trial queries", "tracker configuration", fmt::format("none of {} hands is looked up", kMaxDraws),
              "one that looks up most hands");
}

}  // namespace

HandFrame draw_trial_hand(const PostureSet& postures, RandomStream& random) {
  const size_t count = postures.postures.size();
  const size_t first = random.index(count);
  const size_t second = count == 1 ? first : (first + 1 + random.index(count - 1)) % count;
  const double share = random.uniform();
  HandFrame hand;
  hand.posture = (1 - share) * postures.postures[first] + share * postures.postures[second];
  for (double& angle : hand.posture) angle += radians_from_degrees(kTrialAngleNoise_deg) * random.normal();
  hand.posture = clamp_to_limits(hand.posture);
  // A normal 4-vector has a uniform direction, so its quaternion is a uniform rotation.
  Eigen::Vector4d q;
  for (double& x : q) x = random.normal();
  hand.T_camera_hand.linear() = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  Eigen::Vector3d offset;
  for (int i = 0; i < 3; ++i) offset[i] = random.uniform(-kTrialReach[i], kTrialReach[i]);
  hand.T_camera_hand.translation() = Eigen::Vector3d(0, 0, kTrialDistance) + offset;
  return hand;
}

TrialCamera::TrialCamera(Workbench& workbench, const TrackerConfig& config, const render::NoiseConfig& noise)
    : config_(config),
      noise_(noise),
      model_(workbench.model()),
      table_(workbench.color_table(config.segmentation.color_space)),
      renderer_(workbench.calibration(), model_, render::SceneConfig{}) {}

std::optional<LabelImage> TrialCamera::see(const HandFrame& hand, const render::FrameKey& key) {
  const RgbdCalibration& calibration = renderer_.calibration();
  const render::RgbdImages images =
      renderer_.render(model_->pose(hand.posture), hand.T_camera_hand, render::Lighting{});
  const DeviceFrame frame = render::make_device_frame(images, calibration, 0, noise_, key);

  Sighting seen = glovebench::see(frame, calibration, *table_, config_);
  if (seen.status != TrackStatus::tracked) return std::nullopt;
  return std::move(seen.cloud.labels);
}

std::vector<TrialQuery> make_trial_queries(Workbench& workbench, const TrackerConfig& config,
                                           const PostureSet& postures, std::span<const int> sizes, uint64_t seed,
                                           int count) {
  workbench.color_table(
      config.segmentation.color_space);  // before the threads start, since calibration uses all threads
  std::vector<TrialQuery> queries(count);
  // A camera needs the OpenGL context of the thread that made it.
  tbb::enumerable_thread_specific<std::unique_ptr<TrialCamera>> cameras;
  Progress progress("drawing trial queries", workbench.config().quiet);
  std::atomic<int> done{0};
  in_parallel(workbench.config().threads, queries.size(), [&](size_t number) {
    std::unique_ptr<TrialCamera>& camera = cameras.local();
    if (!camera) camera = std::make_unique<TrialCamera>(workbench, config, render::NoiseConfig{});
    queries[number] = make_trial_query(*camera, postures, sizes, seed, static_cast<int>(number));
    progress.show(static_cast<double>(++done) / count);
  });
  return queries;
}

}  // namespace glovebench::eval
