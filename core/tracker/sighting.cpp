#include "core/tracker/sighting.h"

#include "core/kinect/disparity.h"
#include "core/tracker/detection.h"

namespace glovebench {

Sighting see(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
             const TrackerConfig& config, const StageObserver& observe) {
  Sighting seen;
  observe("register");
  seen.depth = depth_from_disparity(frame.raw_disparity);
  seen.mapped = register_color(seen.depth, frame.color, calibration, config.registration);

  observe("segment");
  seen.labels = segment(seen.mapped, table);
  if (config.segmentation.majority_filter) seen.labels = majority_filter(seen.labels);

  observe("cloud");
  seen.cloud = build_cloud(seen.depth, seen.labels, calibration.ir, config.volume);
  if (config.segmentation.largest_component) {
    seen.cloud = largest_component(seen.cloud, config.detection.component_depth_step);
  }
  seen.status = detect(seen.cloud, config.detection);
  return seen;
}

}  // namespace glovebench
