#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// A posed hand's triangles that face a viewpoint, by color. Hand frame, m.
class Surface {
 public:
  struct Face {
    Eigen::Vector3f a, b, c;
    uint32_t triangle;  ///< in the model
  };
  enum class Coloring { by_color, any_color };
  /// The label of faces with `any_color`.
  static constexpr uint8_t kAnyColor = 0;

  Surface() = default;
  /// Culls faces that look away.
  /// Paper: section III-C.
  Surface(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
          Coloring coloring = Coloring::by_color) {
    assign(model, hand, viewpoint_hand, coloring);
  }
  void assign(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
              Coloring coloring);

  const RecycledVector<Face>& faces(uint8_t label) const { return faces_[label]; }
  bool empty() const;

 private:
  std::array<RecycledVector<Face>, kColorCount + 1> faces_;
};

/// Mean of camera-facing faces, weighted by visible area. Hand frame, m. The origin without any.
Eigen::Vector3f seen_center(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand);

struct ClosestPoint {
  Eigen::Vector3f p_hand = Eigen::Vector3f::Zero();
  float distance = 0;  ///< m
  int face = -1;       ///< in Surface::faces of the point's color; -1: none
};

/// Ericson, Real-Time Collision Detection, section 5.1.5.
Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p, const Surface::Face& face);

/// Searches all faces of each point's label. Of equally near faces the first wins. Face -1: no finite squared
/// distance.
RecycledVector<ClosestPoint> closest_points_plain(std::span<const LabeledPoint> points_hand,
                                                  const Surface& surface);

}  // namespace glovebench
