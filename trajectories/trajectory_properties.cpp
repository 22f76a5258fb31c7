#include "trajectories/trajectory_properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

constexpr int kFirstFingerAngle = kThumbCmcAbduction;
constexpr int kFingerAngleCount = kAngleCount - kFirstFingerAngle;

double rotation_between(const HandFrame& a, const HandFrame& b) {
  return Eigen::AngleAxisd(a.T_camera_hand.linear().transpose() * b.T_camera_hand.linear()).angle();
}

double distance_between(const HandFrame& a, const HandFrame& b) {
  return (a.T_camera_hand.translation() - b.T_camera_hand.translation()).norm();
}

void measure_pose(const std::vector<HandFrame>& frames, TrajectoryProperties& properties) {
  for (size_t i = 0; i < frames.size(); ++i) {
    for (size_t j = i + 1; j < frames.size(); ++j) {
      properties.travel = std::max(properties.travel, distance_between(frames[i], frames[j]));
      properties.rotation = std::max(properties.rotation, rotation_between(frames[i], frames[j]));
    }
    if (i == 0) continue;
    const double step = distance_between(frames[i - 1], frames[i]);
    const double step_s = static_cast<double>(frames[i].timestamp_us - frames[i - 1].timestamp_us) * 1e-6;
    properties.path_length += step;
    properties.peak_speed = std::max(properties.peak_speed, step / step_s);
  }
}

double range_of(const std::vector<HandFrame>& frames, Angle angle) {
  const auto [low, high] =
      std::ranges::minmax(frames, {}, [angle](const HandFrame& frame) { return frame.posture[angle]; });
  return high.posture[angle] - low.posture[angle];
}

/// Share of the way from the open hand to the grasp, by projection of the finger angles.
double closure(const Posture& posture, const Posture& open, const Posture& grasp) {
  const Eigen::VectorXd way = (grasp - open).tail<kFingerAngleCount>();
  return (posture - open).tail<kFingerAngleCount>().dot(way) / way.squaredNorm();
}

std::vector<GraspTransition> find_transitions(const std::vector<double>& closures) {
  std::vector<GraspTransition> transitions;
  int last_open = -1, last_grasp = -1;
  for (int f = 0; f < static_cast<int>(closures.size()); ++f) {
    if (closures[f] < kTransitionEnd) {
      if (last_grasp > last_open) transitions.push_back({last_grasp, f, false});
      last_open = f;
    } else if (closures[f] > 1 - kTransitionEnd) {
      if (last_open > last_grasp) transitions.push_back({last_open, f, true});
      last_grasp = f;
    }
  }
  return transitions;
}

int longest_hold(const std::vector<HandFrame>& frames, const Posture& posture) {
  int longest = 0, length = 0;
  for (const HandFrame& frame : frames) {
    const bool settled = finger_distance(frame.posture, posture) < radians_from_degrees(kSettledDeg);
    length = settled ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest;
}

// A hand that moves reaches the first in radians; no joint exceeds the second, but one finger that bends does in
// degrees.
constexpr double kLeastOfMovement = 0.5, kMostRadians = 3.2;

bool are_most_inside(const std::vector<double>& z, double factor, const WorkingVolume& volume) {
  const auto inside = std::ranges::count_if(
      z, [&](double each) { return factor * each >= volume.z_min && factor * each <= volume.z_max; });
  return 2 * inside >= std::ssize(z);
}

std::string likely_cause(const std::vector<double>& z, const WorkingVolume& volume) {
  for (const auto& [factor, unit] : {std::pair{1000.0, "meters"}, std::pair{10.0, "centimeters"}})
    if (are_most_inside(z, factor, volume))
      return fmt::format("the positions look like {}, position_mm is in millimeters", unit);
  if (are_most_inside(z, -1, volume)) return "the positions look like those of a camera that looks along -z";
  return "position_mm is the hand's place in the camera's frame, z forward";
}

}  // namespace

double finger_distance(const Posture& a, const Posture& b) {
  return std::sqrt((a - b).tail<kFingerAngleCount>().squaredNorm() / kFingerAngleCount);
}

TrajectoryProperties measure(const Trajectory& trajectory, const Posture& open, const Posture& grasp) {
  const std::vector<HandFrame>& frames = trajectory.frames;
  check(!frames.empty(), "a trajectory has frames");
  TrajectoryProperties properties;
  properties.frames = static_cast<int>(frames.size());
  properties.duration_s = static_cast<double>(frames.back().timestamp_us - frames.front().timestamp_us) * 1e-6;
  measure_pose(frames, properties);
  properties.wrist_flexion_range = range_of(frames, kWristFlexion);
  properties.wrist_abduction_range = range_of(frames, kWristAbduction);

  std::vector<double> closures;
  for (const HandFrame& frame : frames) {
    closures.push_back(closure(frame.posture, open, grasp));
    const double nearest = std::min(finger_distance(frame.posture, open), finger_distance(frame.posture, grasp));
    if (nearest < radians_from_degrees(kSettledDeg)) ++properties.settled_frames;
  }
  properties.transitions = find_transitions(closures);
  properties.longest_open_hold = longest_hold(frames, open);
  properties.longest_grasp_hold = longest_hold(frames, grasp);
  return properties;
}

std::string properties_table(const std::vector<Trajectory>& trajectories,
                             const std::vector<TrajectoryProperties>& properties) {
  check(trajectories.size() == properties.size(), "each trajectory has its properties");
  std::string table =
      "| | frames | travel [mm] | path [mm] | rotation [deg] | peak speed [m/s] | wrist flexion / abduction range "
      "[deg] | open-grasp transitions [frames] | longest hold open / grasp [frames] | settled [frames] |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (size_t i = 0; i < properties.size(); ++i) {
    const TrajectoryProperties& p = properties[i];
    std::vector<int> transitions;
    for (const GraspTransition& transition : p.transitions) transitions.push_back(transition.frames());
    table += fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.2f} | {:.0f} / {:.0f} | {} | {} / {} | {} |\n",
                         trajectories[i].name, p.frames, p.travel * 1000, p.path_length * 1000,
                         degrees_from_radians(p.rotation), p.peak_speed,
                         degrees_from_radians(p.wrist_flexion_range), degrees_from_radians(p.wrist_abduction_range),
                         fmt::join(transitions, ", "), p.longest_open_hold, p.longest_grasp_hold, p.settled_frames);
  }
  return table;
}

std::string angle_doubt(std::span<const Posture> postures) {
  double largest = 0;
  for (const Posture& posture : postures)
    largest = std::max(largest, degrees_from_radians(posture.cwiseAbs().maxCoeff()));
  if (largest < kLeastOfMovement || largest > kMostRadians) return "";
  return fmt::format("no angle exceeds {:.2f} degrees: the angles look like radians, angles_deg is in degrees",
                     largest);
}

std::vector<std::string> unit_doubts(const Trajectory& trajectory, const WorkingVolume& volume) {
  std::vector<std::string> doubts;
  std::vector<double> z;
  std::vector<Posture> postures;
  for (const HandFrame& frame : trajectory.frames) {
    z.push_back(frame.T_camera_hand.translation().z());
    postures.push_back(frame.posture);
  }
  if (!are_most_inside(z, 1, volume)) {
    const auto [nearest, farthest] = std::ranges::minmax(z);
    doubts.push_back(fmt::format(
        "most frames lie outside of the working volume, {:g} to {:g} mm from the camera (z of the hand: "
        "{:g} to {:g} mm): {}",
        1000 * volume.z_min, 1000 * volume.z_max, 1000 * nearest, 1000 * farthest, likely_cause(z, volume)));
  }
  if (const std::string doubt = angle_doubt(postures); !doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

HandFrame frame_between(const HandFrame& before, const HandFrame& after, double share) {
  HandFrame frame;
  const auto passed_us = static_cast<double>(after.timestamp_us - before.timestamp_us);
  frame.timestamp_us = before.timestamp_us + std::llround(share * passed_us);
  frame.posture = (1 - share) * before.posture + share * after.posture;
  frame.T_camera_hand.linear() = Eigen::Quaterniond(before.T_camera_hand.linear())
                                     .slerp(share, Eigen::Quaterniond(after.T_camera_hand.linear()))
                                     .toRotationMatrix();
  frame.T_camera_hand.translation() =
      (1 - share) * before.T_camera_hand.translation() + share * after.T_camera_hand.translation();
  return frame;
}

}  // namespace glovebench::trajectories
