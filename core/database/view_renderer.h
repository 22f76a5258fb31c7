#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// Draws the hand's labels as a camera sees them. `render` implements it with OSMesa; an object belongs to
/// one thread.
class ViewRenderer {
 public:
  virtual ~ViewRenderer() = default;
  /// Labels of the nearest surfaces, 0 where there is none. Camera axes: x right, y down, z forward.
  virtual LabelImage render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                                   const Eigen::Isometry3d& T_camera_hand) = 0;
};

using ViewRendererFactory = std::function<std::unique_ptr<ViewRenderer>()>;

}  // namespace glovebench
