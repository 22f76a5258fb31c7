#pragma once

#include <Eigen/Core>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// Depth range in which the hand is looked for (equation 1).
struct WorkingVolume {
  double z_min = 0.40;  ///< m, > 0
  double z_max = 0.95;  ///< m, > z_min; the table of the synthetic scene lies at 1.06
};

/// How far beyond the working volume glove pixels count as parts of a hand that reaches out of it, m.
inline constexpr double kCutOffMargin = 0.05;

struct LabeledPoint {
  Eigen::Vector3f p;  ///< m; camera frame in a cloud
  uint8_t label = 0;  ///< 1..kColorCount
};

/// The color-labeled point cloud C of equation (1), in row-major order of its pixels, with what is needed to
/// say why it is small.
struct LabeledCloud {
  RecycledVector<LabeledPoint> points;
  LabelImage labels;        ///< L masked by C: labels of the points in the cloud, 0 elsewhere
  int labeled_outside = 0;  ///< glove pixels with depth outside the working volume
  int labeled_cut_off = 0;  ///< those of them within kCutOffMargin of it
};

/// Equation (1): glove pixels with a depth in the working volume.
LabeledCloud build_cloud(const DepthImage& depth, const LabelImage& labels, const PinholeCamera& camera,
                         const WorkingVolume& volume);

/// Connected components (8-neighborhood; neighbors also lie within `depth_step` metres of each other) of the
/// glove pixels, largest first, as pixel counts.
RecycledVector<int> component_sizes(const LabeledCloud& cloud, double depth_step);
/// Keeps the largest connected component only (a configuration, not in the paper).
LabeledCloud largest_component(const LabeledCloud& cloud, double depth_step);

}  // namespace glovebench
