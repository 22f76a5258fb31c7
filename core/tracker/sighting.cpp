#include "core/tracker/sighting.h"

#include <algorithm>
#include <cmath>

#include "core/kinect/disparity.h"
#include "core/segmentation/color_table.h"

namespace glovebench {
namespace {

int border_pixels(const LabelImage& labels) {
  int count = 0;
  const int w = labels.width(), h = labels.height();
  for (int u = 0; u < w; ++u) count += (labels(u, 0) != 0) + (labels(u, h - 1) != 0);
  for (int v = 1; v + 1 < h; ++v) count += (labels(0, v) != 0) + (labels(w - 1, v) != 0);
  return count;
}

Sighting see_in(DepthImage depth, const ColorImage& color, const RgbdCalibration& calibration,
                const ColorTable& table, const TrackerConfig& config, const StageObserver& observe) {
  Sighting seen;
  seen.depth = std::move(depth);
  seen.mapped = register_color(seen.depth, color, calibration, config.registration);

  observe(Stage::segmentation);
  seen.labels = segment(seen.mapped, table);
  if (config.segmentation.majority_filter) seen.labels = majority_filter(seen.labels);
  if (config.segmentation.surface_majority) seen.labels = surface_majority(seen.labels, seen.depth);

  observe(Stage::cloud);
  seen.cloud = build_cloud(seen.depth, seen.labels, calibration.ir, config.volume);
  if (config.segmentation.largest_component)
    seen.cloud = largest_component(seen.cloud, config.detection.component_depth_step);
  seen.status = detect(seen.cloud, config.detection);
  return seen;
}

constexpr float kDepthStep = 0.010;  ///< m: a point beside a larger one lies on an edge and may be anywhere
constexpr float kBehindHand = 0.13;  ///< m: what is this much farther than the hand's mean depth is not the hand
constexpr int kMaskMargin_px = 40;
/// m behind the volume: what may be cut off, and the neighbors that decide on its labels.
constexpr double kReach = kCutOffMargin + kSurfaceStep;

/// Does a neighbor of a pixel within the image lie at another depth, or at none?
bool is_at_edge(const DepthImage& depth, int u, int v) {
  if (u == 0 || v == 0 || u + 1 == depth.width() || v + 1 == depth.height()) return true;
  const float z = depth(u, v);
  const float farthest = std::max(std::max(std::abs(depth(u - 1, v) - z), std::abs(depth(u + 1, v) - z)),
                                  std::max(std::abs(depth(u, v - 1) - z), std::abs(depth(u, v + 1) - z)));
  return farthest > kDepthStep;
}

float mean_depth(std::span<const LabeledPoint> points) {
  double sum = 0;
  for (const LabeledPoint& point : points) sum += point.p.z();
  return static_cast<float>(sum / static_cast<double>(points.size()));
}

}  // namespace

bool is_cut_by_border(const LabelImage& labels, size_t glove_pixels, const DetectionConfig& config) {
  const double size_px = std::sqrt(static_cast<double>(glove_pixels));
  return border_pixels(labels) > std::min<double>(config.max_border_pixels, config.max_border_share * size_px);
}

TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config) {
  if (static_cast<int>(cloud.points.size()) < config.min_pixels)
    return cloud.labeled_outside >= config.min_pixels ? TrackStatus::outside_volume : TrackStatus::no_hand;
  // With a third of the glove cut off, the rest would be matched as a whole hand.
  if (2 * cloud.labeled_cut_off > static_cast<int>(cloud.points.size())) return TrackStatus::outside_volume;
  if (is_cut_by_border(cloud.labels, cloud.points.size(), config)) return TrackStatus::cut_by_border;
  const RecycledVector<int> sizes = component_sizes(cloud, config.component_depth_step);
  if (sizes.size() > 1 && sizes[1] > config.second_hand_share * sizes[0]) return TrackStatus::several_hands;
  return TrackStatus::tracked;
}

Sighting see(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
             const TrackerConfig& config) {
  return see_in(depth_of(frame, calibration.disparity), frame.color, calibration, table, config, unobserved);
}

Sighting see_in_reach(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
                      const TrackerConfig& config, const StageObserver& observe) {
  observe(Stage::registration);
  // The majority filter's neighbors may be at any depth.
  if (!config.segmentation.majority_filter) {
    Sighting seen = see_in(depth_of(frame, calibration.disparity, config.volume.z_max + kReach), frame.color,
                           calibration, table, config, observe);
    // With too few points the status depends on what lies outside.
    if (static_cast<int>(seen.cloud.points.size()) >= config.detection.min_pixels) return seen;
    observe(Stage::registration);
  }
  return see_in(depth_of(frame, calibration.disparity), frame.color, calibration, table, config, observe);
}

void HandView::assign(const Sighting& seen, const DeviceFrame& frame, const WorkingVolume& volume) {
  const LabeledCloud& cloud = seen.cloud;
  const float farthest =
      std::min(mean_depth(cloud.points) + kBehindHand, static_cast<float>(volume.z_max + kCutOffMargin));
  mask.assign(seen.depth, frame, label_box(cloud.labels, kMaskMargin_px), farthest);
  points.clear();
  points.reserve(cloud.points.size());
  size_t next = 0;
  for (int v = 0; v < seen.depth.height(); ++v) {
    for_each_nonzero(cloud.labels, v, [&](int u) {
      const LabeledPoint& point = cloud.points[next++];
      if (!is_at_edge(seen.depth, u, v)) points.push_back(point);
    });
  }
}

}  // namespace glovebench
