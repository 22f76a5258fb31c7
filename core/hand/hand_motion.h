#pragma once

#include <array>
#include <vector>

#include "core/hand/hand_model.h"

namespace glovebench {

/// A point q moves by axis x q + moment per radian. Hand frame, m.
struct Screw {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit length, right-handed
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand);

/// Rigid bodies: palm, three segments of each finger, forearm.
inline constexpr int kBodyCount = 17;
/// The angles that move a body, as bits; none for body 0, the palm.
uint32_t angles_of_body(int body);
/// Each body's share in a surface point; the sum is 1.
using BodyShares = std::array<float, kBodyCount>;
std::vector<BodyShares> body_shares(const HandModel& model);

/// How much a surface point follows each angle, 0..1: the summed shares of the bodies that the angle moves.
using AngleShares = Eigen::Matrix<float, kAngleCount, 1>;
AngleShares angle_shares(const BodyShares& shares);

}  // namespace glovebench
