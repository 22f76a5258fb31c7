#pragma once

#include "core/base/image.h"
#include "core/cloud/labeled_cloud.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// Does the glove touch the image border over a longer stretch than `config` allows? Then its bounding box is not
/// the hand's. `glove_pixels` is the number of labeled pixels.
bool is_cut_by_border(const LabelImage& labels, size_t glove_pixels, const DetectionConfig& config);

/// Is there one whole hand in the cloud? `tracked` if so, else why not.
TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config);

}  // namespace glovebench
