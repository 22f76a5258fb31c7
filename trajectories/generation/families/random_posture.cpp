#include "trajectories/generation/families/random_posture.h"

#include <cmath>
#include <numbers>

#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

constexpr int kBentFingers = 4;  // index to little: abduction, MCP, PIP, DIP of each

/// Four uniform numbers in 0..1, of which neighbors have the correlation kNeighborCorrelation: normal ones through
/// their own distribution. Pearson 1907: uniform numbers correlate by 6 / pi * asin(r / 2) if the normal ones do
/// by r.
std::array<double, kBentFingers> correlated_shares(RandomStream& random) {
  const double r = 2 * std::sin(std::numbers::pi * kNeighborCorrelation / 6);
  std::array<double, kBentFingers> shares;
  double normal = random.normal();
  for (double& share : shares) {
    share = std::erfc(-normal / std::numbers::sqrt2) / 2;
    normal = r * normal + std::sqrt(1 - r * r) * random.normal();
  }
  return shares;
}

/// Fingers spread like a fan, each a little on its own; a fist cannot spread.
double random_abduction_deg(int finger, double mcp_share, double fan, RandomStream& random) {
  constexpr std::array<double, kBentFingers> fan_deg = {6, 0, -6, -13};
  const double own = random.uniform(-4, 4);
  return (1 - 0.8 * mcp_share) * (fan * fan_deg[finger] + own);
}

}  // namespace

Posture random_posture(const MovementFamily& family, const Range& bend, RandomStream& random) {
  constexpr double straight_mcp_deg = -10, bent_mcp_deg = 90, bent_pip_deg = 105;
  const auto share_of = [&](double uniform) { return std::lerp(bend.low, bend.high, uniform); };
  std::array<double, kAngleCount> degrees{};
  for (const int angle : {kWristFlexion, kWristAbduction}) {
    const AngleInfo& limits = angle_infos()[angle];
    degrees[angle] = family.wrist * random.uniform(limits.min_deg, limits.max_deg);
  }
  degrees[kThumbCmcAbduction] = random.uniform(0, 55);
  degrees[kThumbCmcFlexion] = random.uniform(-15, 45);
  degrees[kThumbMcpFlexion] = random.uniform(-5, 60);
  degrees[kThumbIpFlexion] = random.uniform(-10, 75);
  const std::array<double, kBentFingers> mcp = correlated_shares(random), pip = correlated_shares(random);
  const double fan = random.uniform(0.2, 1.6);
  for (int finger = 0; finger < kBentFingers; ++finger) {
    double* const angles = &degrees[kIndexMcpAbduction + 4 * finger];
    angles[0] = random_abduction_deg(finger, share_of(mcp[finger]), fan, random);
    angles[1] = std::lerp(straight_mcp_deg, bent_mcp_deg, share_of(mcp[finger]));
    angles[2] = bent_pip_deg * share_of(pip[finger]);
    angles[3] = angles[2] * random.uniform(kDipShare.low, kDipShare.high);
  }
  return posture_from_degrees(degrees);
}

}  // namespace glovebench::trajectories
