#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "eval/estimates/estimate_format.h"
#include "render/subjects/subject.h"
#include "reports/estimates.h"

namespace glovebench::eval {

// Truths as estimates, in each format.

inline std::string run_text(std::span<const HandFrame> frames) {
  reports::ExperimentEstimates estimates;
  int number = 0;
  for (const HandFrame& f : frames)
    estimates.estimates.push_back({1, number++, f.timestamp_us, TrackStatus::tracked, f.posture, f.T_camera_hand});
  return reports::estimates_csv(estimates);
}

inline std::string track_text(std::span<const HandFrame> frames) {
  std::string text;
  for (const HandFrame& f : frames) {
    TrackResult result;
    result.timestamp_us = f.timestamp_us;
    result.status = TrackStatus::tracked;
    result.posture = f.posture;
    result.T_camera_hand = f.T_camera_hand;
    text += estimate_line(0, result) + "\n";
  }
  return text;
}

inline std::string numbers_text(std::span<const double> numbers, const char* separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

inline std::string tum_text(std::span<const HandFrame> frames, bool wxyz = false) {
  std::string text = "# time x y z qx qy qz qw\n";
  for (const HandFrame& f : frames) {
    const Eigen::Vector3d p = f.T_camera_hand.translation();
    const Eigen::Quaterniond q(f.T_camera_hand.linear());
    const std::array<double, 4> xyzw = {q.x(), q.y(), q.z(), q.w()}, other = {q.w(), q.x(), q.y(), q.z()};
    text += fmt::format("{:.6f} {} {}\n", static_cast<double>(f.timestamp_us) / 1e6,
                        numbers_text({p.data(), 3}, " "), numbers_text(wxyz ? other : xyzw, " "));
  }
  return text;
}

/// `unit`: deg or rad, in the headings. `factor`: of the degrees.
inline std::string angles_text(std::span<const HandFrame> frames, const std::string& unit = "deg",
                               double factor = 1) {
  std::string text = "timestamp_us";
  for (const AngleInfo& info : angle_infos()) text += fmt::format(",{}_{}", info.name, unit);
  for (const HandFrame& f : frames) {
    text += fmt::format("\n{}", f.timestamp_us);
    for (const double angle : f.posture) text += fmt::format(",{}", factor * degrees_from_radians(angle));
  }
  return text + "\n";
}

using Move = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// The joints of an order as glovebench-joints; a point that we lack is at the wrist.
inline std::string joints_text(
    std::span<const HandFrame> frames, const render::Subject& subject, const JointOrder& order,
    const Move& move = [](const Eigen::Vector3d& p) { return p; }, const std::string& frame = "camera") {
  nlohmann::json list = nlohmann::json::array();
  for (const HandFrame& f : frames) {
    const JointPoses joints = subject.joints(f.posture);
    nlohmann::json points = nlohmann::json::array();
    for (const NamedJoint& joint : order.joints) {
      const Eigen::Vector3d p = move(f.T_camera_hand * joints[std::max(joint.joint, 0)].translation());
      points.push_back({p.x(), p.y(), p.z()});
    }
    list.push_back({{"time_s", static_cast<double>(f.timestamp_us) / 1e6}, {"joints_m", std::move(points)}});
  }
  const nlohmann::json document = {{"format", "glovebench-joints"},
                                   {"version", 1},
                                   {"order", order.name},
                                   {"frame", frame},
                                   {"frames", std::move(list)}};
  return document.dump();
}

/// The same as CSV, in mm.
inline std::string joint_columns_text(std::span<const HandFrame> frames, const render::Subject& subject,
                                      const JointOrder& order) {
  std::string text = "time_ms";
  for (const NamedJoint& joint : order.joints) text += fmt::format(",{0}_x_mm,{0}_y_mm,{0}_z_mm", joint.name);
  for (const HandFrame& f : frames) {
    const JointPoses joints = subject.joints(f.posture);
    text += fmt::format("\n{}", static_cast<double>(f.timestamp_us) / 1e3);
    for (const NamedJoint& joint : order.joints) {
      const Eigen::Vector3d p = 1000 * (f.T_camera_hand * joints[std::max(joint.joint, 0)].translation());
      text += "," + numbers_text({p.data(), 3}, ",");
    }
  }
  return text + "\n";
}

}  // namespace glovebench::eval
