#pragma once

#include "core/base/image.h"
#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/kinect/device.h"
#include "core/pose/hand_mask.h"
#include "core/segmentation/color_table.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

bool is_cut_by_border(const LabelImage& labels, size_t glove_pixels, const DetectionConfig& config);

/// `tracked` if the cloud is one whole hand.
TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config);

/// What a frame shows before the look-up.
/// Paper: section III-A.
struct Sighting {
  DepthImage depth;
  RegisteredImage mapped;  ///< M
  LabelImage labels;       ///< L
  LabeledCloud cloud;      ///< C
  TrackStatus status = TrackStatus::no_hand;
};

Sighting see(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
             const TrackerConfig& config);
/// The same cloud, status and HandView, faster. Ignores what is far behind the volume, also in `labeled_outside`.
Sighting see_in_reach(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
                      const TrackerConfig& config, const StageObserver& observe);

/// Input of the fit of pose and posture.
struct HandView {
  RecycledVector<LabeledPoint> points;  ///< camera frame, m; none at a surface's edge
  HandMask mask;

  /// `seen` must be `tracked` or `cut_by_border`. The mask ends kCutOffMargin behind the volume. Reuses memory.
  void assign(const Sighting& seen, const DeviceFrame& frame, const WorkingVolume& volume);
};

}  // namespace glovebench
