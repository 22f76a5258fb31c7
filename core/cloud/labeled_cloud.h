#pragma once

#include <Eigen/Core>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// Depth range of the hand.
/// Paper: equation 1.
struct WorkingVolume {
  double z_min = 0.40;  ///< m, > 0
  double z_max = 0.95;  ///< m, > z_min; synthetic table: 1.06
};

/// Glove pixels outside the volume count as cut off within this, m.
inline constexpr double kCutOffMargin = 0.05;

struct LabeledPoint {
  Eigen::Vector3f p;  ///< m, camera frame in a cloud
  uint8_t label = 0;  ///< 1..kColorCount
};

/// The labeled point cloud C, in row-major order of pixels.
/// Paper: equation 1.
struct LabeledCloud {
  RecycledVector<LabeledPoint> points;
  LabelImage labels;        ///< of `points`, 0 elsewhere
  int labeled_outside = 0;  ///< glove pixels with depth outside the volume
  int labeled_cut_off = 0;  ///< of these, within kCutOffMargin
};

/// Takes glove pixels with depth in the volume.
/// Paper: equation 1.
LabeledCloud build_cloud(const DepthImage& depth, const LabelImage& labels, const PinholeCamera& camera,
                         const WorkingVolume& volume);

/// Pixel counts of components, largest first. 8-neighbors connect if their depths differ by at most `depth_step`,
/// m.
RecycledVector<int> component_sizes(const LabeledCloud& cloud, double depth_step);
/// Keeps the largest component. Not in the paper.
LabeledCloud largest_component(const LabeledCloud& cloud, double depth_step);

}  // namespace glovebench
