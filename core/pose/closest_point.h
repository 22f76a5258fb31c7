#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// The triangles of a posed hand that face a viewpoint, by color; hand frame, metres.
class Surface {
 public:
  struct Face {
    Eigen::Vector3f a, b, c;
    uint32_t triangle;  ///< in the model
  };
  enum class Coloring { by_color, any_color };
  /// The label under which a surface without colors (`any_color`) keeps all its faces; its points have it too.
  static constexpr uint8_t kAnyColor = 0;

  Surface() = default;
  /// Faces turned away from `viewpoint_hand` are culled (section III-C).
  Surface(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
          Coloring coloring = Coloring::by_color) {
    assign(model, hand, viewpoint_hand, coloring);
  }
  /// Made anew; keeps its memory.
  void assign(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
              Coloring coloring);

  const RecycledVector<Face>& faces(uint8_t label) const { return faces_[label]; }
  bool empty() const;

 private:
  std::array<RecycledVector<Face>, kColorCount + 1> faces_;
};

/// Center of the faces of a posed hand that look at a viewpoint, weighted by the areas that are seen from there;
/// all in the hand frame, m. The origin if no face does.
Eigen::Vector3f seen_center(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand);

/// A point's closest point on the surface of its color.
struct ClosestPoint {
  Eigen::Vector3f p_hand = Eigen::Vector3f::Zero();
  float distance = 0;  ///< m
  int face = -1;       ///< in Surface::faces of the point's color; -1 if that color faces away altogether
};

/// The closest point of one triangle (Ericson, Real-Time Collision Detection, section 5.1.5).
Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p, const Surface::Face& face);

/// For each point (hand frame) the closest point on the faces of its label; of equally close faces the first. As
/// the paper describes it: every face of the color. A point that is not finite has none (face -1), as has one so
/// far away that the square of its distance is not finite.
RecycledVector<ClosestPoint> closest_points_plain(std::span<const LabeledPoint> points_hand,
                                                  const Surface& surface);

}  // namespace glovebench
