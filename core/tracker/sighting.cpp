#include "core/tracker/sighting.h"

#include "core/kinect/disparity.h"
#include "core/segmentation/surface_majority.h"
#include "core/tracker/detection.h"

namespace glovebench {

namespace {

Sighting see_in(DepthImage depth, const ColorImage& color, const RgbdCalibration& calibration,
                const ColorTable& table, const TrackerConfig& config, const StageObserver& observe) {
  Sighting seen;
  seen.depth = std::move(depth);
  seen.mapped = register_color(seen.depth, color, calibration, config.registration);

  observe("segment");
  seen.labels = segment(seen.mapped, table);
  if (config.segmentation.majority_filter) seen.labels = majority_filter(seen.labels);
  if (config.segmentation.surface_majority) seen.labels = surface_majority(seen.labels, seen.depth);

  observe("cloud");
  seen.cloud = build_cloud(seen.depth, seen.labels, calibration.ir, config.volume);
  if (config.segmentation.largest_component) {
    seen.cloud = largest_component(seen.cloud, config.detection.component_depth_step);
  }
  seen.status = detect(seen.cloud, config.detection);
  return seen;
}

}  // namespace

Sighting see(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
             const TrackerConfig& config, const StageObserver& observe, Extent extent) {
  observe("register");
  // A filter over neighbors looks across the border of what is left out.
  if (extent == Extent::reach && !config.segmentation.majority_filter && !config.segmentation.surface_majority) {
    Sighting seen = see_in(
        depth_from_disparity(frame.raw_disparity, calibration.disparity, config.volume.z_max + kCutOffMargin),
        frame.color, calibration, table, config, observe);
    // With too few points the status depends on what lies outside.
    if (static_cast<int>(seen.cloud.points.size()) >= config.detection.min_pixels) return seen;
    observe("register");
  }
  return see_in(depth_from_disparity(frame.raw_disparity, calibration.disparity), frame.color, calibration, table,
                config, observe);
}

}  // namespace glovebench
