#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/hand/hand_model.h"
#include "core/hand/posture.h"
#include "core/tracker/track_result.h"
#include "render/subjects/subject.h"

namespace glovebench::eval {

/// Columns are points (m, camera axes): joints, else the hand's origin and axes; without both, angles (rad) in one
/// row.
using Points = Eigen::MatrixXd;

struct PointComparison {
  EstimateParts has;
  std::vector<int> joints;  ///< empty: all, if it has posture and pose
  const HandModel* hand = nullptr;

  bool has_joints() const { return has.hand() || !joints.empty(); }
  bool has_points() const { return has_joints() || has.pose; }
  /// Points of a tracked answer.
  Points of(const TrackResult& answer) const;
  Points of(const HandFrame& truth, const render::Subject& subject) const;
  /// Mean, mm or deg. Without place, centers are aligned; without scale, sizes.
  double distance(const Points& estimated, const Points& truth) const;
  const char* unit() const { return has_points() ? "mm" : "deg"; }
};

std::vector<Points> points_of(const PointComparison& comparison, std::span<const HandFrame> truth,
                              const render::Subject& subject);

}  // namespace glovebench::eval
