#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

  /// Faces turned away from `viewpoint_hand` are culled (section III-C).
  Surface(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
          Coloring coloring = Coloring::by_color);

  const std::vector<Face>& faces(uint8_t label) const { return colors_[label].faces; }
  bool empty() const;
  /// Area-weighted center of all faces as seen from the viewpoint (projected area).
  const Eigen::Vector3f& center() const { return center_; }

 private:
  friend class ClosestPointSearch;
  /// Bounding spheres of the faces, for pruning.
  struct Color {
    std::vector<Face> faces;
    std::vector<float> x, y, z, radius;
  };
  std::array<Color, kColorCount + 1> colors_;
  Eigen::Vector3f center_ = Eigen::Vector3f::Zero();
};

/// A point's closest point on the surface of its color.
struct ClosestPoint {
  Eigen::Vector3f p_hand = Eigen::Vector3f::Zero();
  float distance = 0;  ///< m
  int face = -1;       ///< in Surface::faces of the point's color; -1 if that color faces away altogether
};

/// The closest point of one triangle (Ericson, Real-Time Collision Detection, section 5.1.5).
Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p, const Surface::Face& face);

/// For each point (hand frame) the closest point on the faces of its label; of equally close faces the first. As
/// the paper describes it: every face of the color.
std::vector<ClosestPoint> closest_points_plain(std::span<const LabeledPoint> points_hand, const Surface& surface);

/// The same answer, faster, for points that move little from call to call. A face is skipped if its bounding sphere
/// is farther than the best so far; and a point keeps its face without a search if it has moved less than would
/// bring any other face nearer. One object follows one set of points on one surface, which outlives it.
class ClosestPointSearch {
 public:
  explicit ClosestPointSearch(const Surface& surface) : surface_(surface) {}
  std::vector<ClosestPoint> operator()(std::span<const LabeledPoint> points_hand);

 private:
  struct Memory {
    Eigen::Vector3f p_hand;  ///< where the point was at its last full search
    int face = -1;
    float others_beyond = 0;  ///< every other face was at least this far from p_hand, m
  };
  ClosestPoint search(const LabeledPoint& point, Memory& memory);

  const Surface& surface_;
  std::vector<Memory> memory_;
  std::vector<float> gap_;  ///< reused by `search`
};

}  // namespace glovebench
