#include "trajectories/generation/natural_variation.h"

#include <cmath>
#include <numbers>

#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

constexpr int kFingerCount = 4;  ///< index to little

/// The four angles of a finger follow each other: abduction, MCP, PIP, DIP.
int first_angle(int finger) { return kIndexMcpAbduction + 4 * finger; }

void bend(Posture& mode, int finger, double mcp, double pip) {
  mode[first_angle(finger) + 1] += mcp;
  mode[first_angle(finger) + 2] += pip;
  mode[first_angle(finger) + 3] += pip * kEndJointShare;
}

Posture normalized(const Posture& mode) {
  return mode * (radians_from_degrees(1) / posture_distance(mode, Posture::Zero()));
}

Posture fingers_bend_together() {
  Posture mode = Posture::Zero();
  for (int finger = 0; finger < kFingerCount; ++finger) bend(mode, finger, 1, 1.2);
  mode[kThumbMcpFlexion] = 0.5;
  mode[kThumbIpFlexion] = 0.5;
  return mode;
}

Posture knuckles_against_middle_joints() {
  Posture mode = Posture::Zero();
  for (int finger = 0; finger < kFingerCount; ++finger) bend(mode, finger, 1, -1);
  return mode;
}

Posture little_side_bends_more() {
  Posture mode = Posture::Zero();
  for (int finger = 0; finger < kFingerCount; ++finger) bend(mode, finger, finger - 1.5, finger - 1.5);
  return mode;
}

Posture fingers_spread() {
  Posture mode = Posture::Zero();
  constexpr std::array<double, kFingerCount> shares = {1, 0.2, -0.6, -1.4};
  for (int finger = 0; finger < kFingerCount; ++finger) mode[first_angle(finger)] = shares[finger];
  mode[kThumbCmcAbduction] = 0.5;
  return mode;
}

Posture thumb_opposes() {
  Posture mode = Posture::Zero();
  mode[kThumbCmcAbduction] = 1;
  mode[kThumbCmcFlexion] = 0.7;
  mode[kThumbMcpFlexion] = 0.4;
  return mode;
}

Posture thumb_bends() {
  Posture mode = Posture::Zero();
  mode[kThumbMcpFlexion] = 1;
  mode[kThumbIpFlexion] = 1.2;
  mode[kThumbCmcFlexion] = -0.4;
  return mode;
}

/// Neighbors follow by a third: tendons are shared.
Posture one_finger_bends(int leader) {
  Posture mode = Posture::Zero();
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const int steps = std::abs(finger - leader);
    const double share = steps == 0 ? 1 : steps == 1 ? 1.0 / 3.0 : 0;
    bend(mode, finger, share, share);
  }
  return mode;
}

std::vector<Posture> make_modes() {
  std::vector<Posture> modes = {fingers_bend_together(),  knuckles_against_middle_joints(),
                                little_side_bends_more(), fingers_spread(),
                                thumb_opposes(),          thumb_bends()};
  for (int finger = 0; finger < kFingerCount; ++finger) modes.push_back(one_finger_bends(finger));
  for (Posture& mode : modes) mode = normalized(mode);
  return modes;
}

}  // namespace

const std::vector<Posture>& variation_modes() {
  static const std::vector<Posture> modes = make_modes();
  return modes;
}

SmoothNoise::SmoothNoise(RandomStream& random, double low_hz, double high_hz) {
  for (Wave& wave : waves_) {
    wave.frequency_hz = random.uniform(low_hz, high_hz);
    wave.phase = random.uniform(0, 2 * std::numbers::pi);
  }
}

double SmoothNoise::at(double time_s) const {
  double sum = 0;
  for (const Wave& wave : waves_) sum += std::sin(2 * std::numbers::pi * wave.frequency_hz * time_s + wave.phase);
  return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
}

}  // namespace glovebench::trajectories
