#pragma once

#include "core/base/image.h"
#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/kinect/device.h"
#include "core/segmentation/color_table.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// Does the glove touch the image border over a longer stretch than `config` allows? Then its bounding box is not
/// the hand's. `glove_pixels` is the number of labeled pixels.
bool is_cut_by_border(const LabelImage& labels, size_t glove_pixels, const DetectionConfig& config);

/// Is there one whole hand in the cloud? `tracked` if so, else why not.
TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config);

/// What a frame shows before anything is looked up (section III-A), stage by stage.
struct Sighting {
  DepthImage depth;
  RegisteredImage mapped;                     ///< M
  LabelImage labels;                          ///< L
  LabeledCloud cloud;                         ///< C
  TrackStatus status = TrackStatus::no_hand;  ///< `tracked` if there is one whole hand to look up
};

/// Registers, segments, and makes the cloud, of the whole images.
Sighting see(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
             const TrackerConfig& config);
/// The same cloud and status, faster: what lies more than `kCutOffMargin` beyond the working volume is left out of
/// the images and of `labeled_outside`. It can neither be in the cloud nor hide from the RGB camera what is. If too
/// few points are left, everything is done again with the whole images.
Sighting see_in_reach(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
                      const TrackerConfig& config, const StageObserver& observe);

}  // namespace glovebench
