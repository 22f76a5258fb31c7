#include "trajectories/generation/families/movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "core/camera/rgbd_calibration.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/families/solid_hand.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::trajectories {
namespace {

constexpr int kStarts = 1000, kDrawsOfAWay = 200;
constexpr double kMinimumJerkPeak = 1.875;  // the peak speed of a way, in its mean speed

/// How the keys of a pose or a posture come about.
template <typename Value>
struct KeySource {
  std::function<Value(size_t key)> draw;
  std::function<int(const Value& from, const Value& to)> frames_between;
  std::function<bool(const Value& value)> fits;  ///< true if a frame may look like that
  std::string wanted;                            ///< what fits, for a message
};

/// True if all frames of the way fit. The last one is the likeliest not to.
template <typename Value>
bool way_fits(const KeySource<Value>& source, const Value& from, const Value& to, int frames) {
  for (int f = frames; f > 0; --f)
    if (!source.fits(mix(from, to, minimum_jerk(static_cast<double>(f) / frames)))) return false;
  return true;
}

template <typename Value>
struct Way {
  Value to;
  int frames;
};

/// The way to a new key, if one of so many draws has a way that fits.
template <typename Value>
std::optional<Way<Value>> find_way(const KeySource<Value>& source, const Value& from, size_t key) {
  for (int i = 0; i < kDrawsOfAWay; ++i) {
    const Value to = source.draw(key);
    const int frames = source.frames_between(from, to);
    if (way_fits(source, from, to, frames)) return Way<Value>{to, frames};
  }
  return std::nullopt;
}

/// Keys up to the last frame, with a rest after each. From a dead end the same way leads back, which fits. Keys do
/// not depend on how many frames are asked for.
template <typename Value>
std::vector<Keyframe<Value>> random_keys(const KeySource<Value>& source, int frame_count,
                                         const std::string& movement, RandomStream& random) {
  constexpr auto longest_rest = static_cast<uint64_t>(kLongestMovementRestS * kFrameRateHz);
  std::vector<Keyframe<Value>> keys(1);
  std::optional<Way<Value>> way;
  for (int i = 0; i < kStarts && !way; ++i) {
    keys[0].value = source.draw(0);
    if (source.fits(keys[0].value)) way = find_way(source, keys[0].value, 1);
  }
  if (!way) throw Error(movement, "ranges", fmt::format("none of {} draws that fits", kStarts), source.wanted);
  for (size_t number = 2;; ++number) {
    const Value before = keys.back().value;
    keys.push_back({keys.back().frame + way->frames, way->to});
    const auto rest = static_cast<int>(random.index(longest_rest + 1));
    if (rest > 0) keys.push_back({keys.back().frame + rest, keys.back().value});
    if (keys.back().frame >= frame_count - 1) return keys;
    const std::optional<Way<Value>> next = find_way(source, keys.back().value, number);
    way = next ? next : Way<Value>{before, way->frames};
  }
}

int frames_of_time(double time_s) {
  constexpr int fewest = 2;
  return std::max(fewest, static_cast<int>(std::ceil(time_s * kFrameRateHz)));
}

HandPose random_pose(const MovementFamily& family, bool reversed, RandomStream& random) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const PinholeCamera camera = synthetic_calibration().ir;
  HandPose pose;
  const double z = random.uniform(family.depth.low, family.depth.high);
  const double u = camera.cx + family.off_axis * random.uniform(-1, 1) * camera.width / 2;
  const double v = camera.cy + family.off_axis * random.uniform(-1, 1) * camera.height / 2;
  pose.position = camera.back_project(u, v, z);
  const double cosine = random.uniform(std::cos(radians_from_degrees(family.tilt_deg.high)),
                                       std::cos(radians_from_degrees(family.tilt_deg.low)));
  const double axis = radians_from_degrees(random.uniform(family.tilt_axis_deg.low, family.tilt_axis_deg.high) +
                                           (reversed ? 180 : 0));
  const double yaw = radians_from_degrees(random.uniform(-family.yaw_deg, family.yaw_deg));
  pose.rotation = AngleAxisd(yaw, Vector3d::UnitZ()) *
                  AngleAxisd(std::acos(cosine), Vector3d(std::cos(axis), std::sin(axis), 0)) *
                  hand_rotation(0, 0, 0);
  return pose;
}

std::vector<Keyframe<HandPose>> pose_keys(const MovementFamily& family, uint64_t seed, int frame_count) {
  RandomStream random(seed, family.name, 0, "movement poses");
  const bool reversed = random.index(2) == 1;
  const KeySource<HandPose> source = {
      .draw = [&](size_t) { return random_pose(family, reversed, random); },
      .frames_between =
          [&](const HandPose& from, const HandPose& to) {
            const double speed = random.uniform(family.speed.low, family.speed.high);
            const double turn_rate = random.uniform(family.turn_rate.low, family.turn_rate.high);
            return frames_of_time(kMinimumJerkPeak *
                                  std::max((to.position - from.position).norm() / speed,
                                           from.rotation.angularDistance(to.rotation) / turn_rate));
          },
      .fits =
          [&](const HandPose& pose) { return family.tilt_deg.holds(tilt_deg(pose.rotation.toRotationMatrix())); },
      .wanted = "ways on which the hand keeps its tilt"};
  return random_keys(source, frame_count, movement_name(family, seed), random);
}

std::vector<Keyframe<Posture>> posture_keys(const MovementFamily& family, uint64_t seed,
                                            const MovementMaterial& material, int frame_count) {
  RandomStream random(seed, family.name, 0, "movement postures");
  const std::vector<Posture>& captured = material.captured.postures;
  const auto is_free = [&](const Posture& posture) {
    const auto is_far = [&](const Posture& gesture) {
      return finger_distance(posture, gesture) >= radians_from_degrees(material.least_distance_deg);
    };
    return std::ranges::all_of(material.gestures.postures, is_far) &&
           deepest_overlap(material.skeleton, posture) <= kMostOverlap;
  };
  const KeySource<Posture> source = {
      .draw =
          [&](size_t key) {
            return family.captured ? captured.at(random.index(captured.size()))
                                   : random_posture(family, family.bends[key % family.bends.size()], random);
          },
      .frames_between =
          [&](const Posture&, const Posture&) {
            return frames_of_time(random.uniform(family.posture_s.low, family.posture_s.high));
          },
      .fits = [&](const Posture& posture) { return family.captured || is_free(posture); },
      .wanted = fmt::format("postures {} deg RMS from each gesture, without parts that pierce each other",
                            material.least_distance_deg)};
  return random_keys(source, frame_count, movement_name(family, seed), random);
}

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

MovementMaterial load_movement_material(const std::string& data_folder, const Skeleton& skeleton) {
  return {load_gestures(data_folder), load_captured_postures(data_folder), skeleton};
}

Trajectory generate_movement(const MovementFamily& family, uint64_t seed, const MovementMaterial& material,
                             int frame_count) {
  check(frame_count > 0, "a movement has frames");
  const std::vector<Keyframe<HandPose>> poses = pose_keys(family, seed, frame_count);
  const std::vector<Keyframe<Posture>> postures = posture_keys(family, seed, material, frame_count);
  Trajectory movement{.name = movement_name(family, seed),
                      .description = fmt::format("Generated: family {}, seed {}", family.name, seed),
                      .provenance = {},
                      .frames = {}};
  for (int f = 0; f < frame_count; ++f) {
    const HandPose pose = value_at(poses, f);
    HandFrame& frame = movement.frames.emplace_back();
    frame.timestamp_us = std::llround(f / kFrameRateHz * 1e6);
    frame.posture = value_at(postures, f);
    frame.T_camera_hand.translation() = pose.position;
    frame.T_camera_hand.linear() = pose.rotation.toRotationMatrix();
  }
  return movement;
}

std::string movement_name(const MovementFamily& family, uint64_t seed) {
  return fmt::format("{}_{}", family.name, seed);
}

std::optional<NamedMovement> find_movement(std::string_view name) {
  for (const MovementFamily& family : movement_families()) {
    if (!name.starts_with(family.name)) continue;
    const std::string_view digits = name.substr(std::min(name.size(), family.name.size() + 1));
    const uint64_t seed = number_in<uint64_t>(digits).value_or(0);
    if (seed <= kMostMovements && name == movement_name(family, seed)) return NamedMovement{&family, seed};
  }
  return std::nullopt;
}

double tilt_deg(const Eigen::Matrix3d& R_camera_hand) {
  const double toward_camera = -(R_camera_hand * Eigen::Vector3d::UnitY()).z();
  return degrees_from_radians(std::acos(std::clamp(toward_camera, -1.0, 1.0)));
}

}  // namespace glovebench::trajectories
