#pragma once

#include "core/pose/articulated_step.h"
#include "core/pose/closest_point.h"

namespace glovebench {

/// 1 at 0, 0 from `width` on.
double tukey_weight(double distance, double width);

struct SurfacePull {
  Pull pull;                 ///< along the normal inside a face, else along the connection
  Eigen::Vector3d apart_mm;  ///< from surface to point, hand frame
  Eigen::Vector3d barycentric;
};
SurfacePull surface_pull(const Surface::Face& face, const ClosestPoint& closest, const Eigen::Vector3f& p_hand,
                         double weight);

}  // namespace glovebench
