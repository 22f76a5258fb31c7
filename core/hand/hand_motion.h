#pragma once

#include <array>
#include <vector>

#include "core/hand/hand_model.h"

namespace glovebench {

/// Point q moves by axis x q + moment per radian. Hand frame, m.
struct Screw {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit length, right-handed
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand);

/// Palm, three segments of each finger, forearm.
inline constexpr int kBodyCount = 17;
/// Bits of the angles that move a body; 0 for the palm, body 0.
uint32_t angles_of_body(int body);
/// A surface point's shares of bodies, sum 1.
using BodyShares = std::array<float, kBodyCount>;
std::vector<BodyShares> body_shares(const HandModel& model);

/// How much a surface point follows each angle, 0..1: its shares of bodies that the angle moves.
using AngleShares = Eigen::Matrix<float, kAngleCount, 1>;
AngleShares angle_shares(const BodyShares& shares);

}  // namespace glovebench
