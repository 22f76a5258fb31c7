#pragma once

#include <array>
#include <vector>

#include "core/hand/hand_model.h"

namespace glovebench {

/// How a point q moves that hangs on a joint whose angle turns: by axis x q + moment a radian. Hand frame, m.
struct Screw {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit length, right-handed
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
/// The screw of each angle in this posture.
std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand);

/// The rigid bodies that the angles move: the palm, three segments of each finger, the forearm.
inline constexpr int kBodyCount = 17;
/// The angles that move a body, as bits. None moves the first one, the palm.
uint32_t angles_of_body(int body);
/// The share of each body in a point of the surface: the sum of its joints' weights; all sum to 1.
using BodyShares = std::array<float, kBodyCount>;
/// One a vertex.
std::vector<BodyShares> body_shares(const HandModel& model);

/// The share of each angle's turn that a point of the surface follows, 0..1: those of the bodies that it moves.
/// With linear blending this is the derivative up to what the bodies of one point disagree on.
using AngleShares = Eigen::Matrix<float, kAngleCount, 1>;
AngleShares angle_shares(const BodyShares& shares);

}  // namespace glovebench
