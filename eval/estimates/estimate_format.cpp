#include "eval/estimates/estimate_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/registry.h"
#include "core/base/text.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {
namespace {

constexpr double kFarthest = 900;  // m; errors stay below the largest that result files may have
constexpr size_t kPoseNumbers = 7;

void check_pose(std::span<const double> pose, const std::string& where, const std::string& field) {
  const Eigen::Map<const Eigen::Vector3d> position(pose.data());
  const double length = Eigen::Map<const Eigen::Vector4d>(pose.data() + 3).norm();
  if (!(position.norm() <= kFarthest))
    throw Error(where, field + ", position", fmt::format("{:g} m away", position.norm()),
                fmt::format("at most {} m (see --units)", kFarthest));
  if (!(std::abs(length - 1) <= trajectories::kQuaternionNormTolerance))
    throw Error(where, field + ", quaternion", fmt::format("length {:.6f}", length),
                fmt::format("length 1 within {}", trajectories::kQuaternionNormTolerance));
}

/// Points in reach, not all in one place, so that sizes can be compared.
void check_joints(std::span<const double> numbers, std::span<const int> joints, const std::string& where,
                  const std::string& field) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(numbers.data(), 3, static_cast<Eigen::Index>(joints.size()));
  if (const double far = points.colwise().norm().maxCoeff(); !(far <= kFarthest))
    throw Error(where, field + ", joints", fmt::format("{:g} m away", far),
                fmt::format("at most {} m (see --units)", kFarthest));
  const auto place = [&](int joint) { return std::ranges::find(joints, joint) - joints.begin(); };
  const Eigen::Index root = place(kWristJoint), knuckle = place(joint_index("middle-finger-phalanx-proximal"));
  const bool has_both = std::max(root, knuckle) < points.cols();
  const double size = has_both ? (points.col(root) - points.col(knuckle)).norm()
                               : (points.colwise() - points.col(0)).colwise().norm().maxCoeff();
  if (!(size > 1e-9)) throw Error(where, field + ", joints", "a hand without size", "joints that are apart");
}

double factor_of(std::string_view unit, const std::string& flag, const std::string& where, const std::string& field,
                 const std::vector<std::pair<std::string_view, double>>& known, const char* name) {
  const std::string_view chosen = unit.empty() ? std::string_view(flag) : unit;
  if (!flag.empty() && flag != chosen)
    throw Error(where, field, std::string(chosen), fmt::format("{}, as {} says", flag, name));
  for (const auto& [word, factor] : known)
    if (word == chosen) return factor;
  std::vector<std::string_view> words;
  for (const auto& [word, factor] : known) words.push_back(word);
  throw Error(where, field, chosen.empty() ? "nothing" : quoted_excerpt(chosen),
              fmt::format("{} in the file or by {}", fmt::join(words, ", "), name));
}

}  // namespace

size_t EstimateSequence::numbers_per_frame() const {
  return (has.posture ? kAngleCount : 0) + (has.pose ? kPoseNumbers : 0) + 3 * joints.size();
}

void EstimateSequence::reserve(size_t frames) {
  timestamps_us.reserve(frames);
  statuses.reserve(frames);
  begins.reserve(frames);
}

void EstimateSequence::add(int64_t timestamp_us, TrackStatus status, std::span<const double> own,
                           const std::string& where, const std::string& field) {
  if (!timestamps_us.empty() && timestamp_us <= timestamps_us.back())
    throw Error(where, field + ", time", fmt::format("{} us", timestamp_us),
                fmt::format("more than the {} us before", timestamps_us.back()));
  timestamps_us.push_back(timestamp_us);
  statuses.push_back(status);
  begins.push_back(numbers.size());
  if (status != TrackStatus::tracked) return;
  check(own.size() == numbers_per_frame(), "a frame has the numbers of its parts");
  numbers.insert(numbers.end(), own.begin(), own.end());
  if (has.posture) own = own.subspan(kAngleCount);
  if (has.pose) check_pose(own.first(kPoseNumbers), where, field);
  if (!joints.empty()) check_joints(own.last(3 * joints.size()), joints, where, field);
}

TrackResult EstimateSequence::answer(size_t frame) const {
  TrackResult result;
  result.timestamp_us = timestamps_us[frame];
  result.status = statuses[frame];
  result.has = has;
  if (result.status != TrackStatus::tracked) return result;
  const double* number = numbers.data() + begins[frame];
  if (has.posture) {
    result.posture = Eigen::Map<const Posture>(number);
    number += kAngleCount;
  }
  if (has.pose) {
    result.T_camera_hand = Eigen::Translation3d(number[0], number[1], number[2]) *
                           Eigen::Quaterniond(number[3], number[4], number[5], number[6]).normalized();
    number += kPoseNumbers;
  }
  if (!joints.empty()) result.joints.resize(kForearmJoint);
  for (size_t j = 0; j < joints.size(); ++j, number += 3)
    result.joints[joints[j]] = Eigen::Vector3d(number[0], number[1], number[2]);
  return result;
}

std::vector<EstimateSequence> load_estimates(const std::string& path, const std::string& format,
                                             const EstimateFlags& flags) {
  const std::string bytes = read_file(path, kLargestMovement);
  const std::string_view first_line = std::string_view(bytes).substr(0, bytes.find('\n'));
  for (const EstimateFormat& each : estimate_formats()) {
    if (format.empty() ? !each.fits(path, first_line) : each.name != format) continue;
    std::vector<EstimateSequence> sequences = each.read(bytes, flags, path);
    if (sequences.empty() || sequences.front().size() == 0) throw Error(path, "estimates", "none", "one or more");
    return sequences;
  }
  throw Error(path, "format", "one that nothing tells",
              "--format with " + one_of(names_in(estimate_formats()), ""));
}

EstimateSequence merged(const EstimateSequence& poses, const EstimateSequence& beside, const std::string& where) {
  const bool has_joints = !beside.joints.empty();
  if (!poses.has.pose || poses.has.posture || !poses.joints.empty() || beside.has.pose)
    throw Error(where, "parts", "those of the estimates", "angles or joints beside a file with poses alone");
  EstimateSequence both;
  both.has = {
      .posture = beside.has.posture, .place = beside.has.place, .scale = beside.has.scale, .internals = false};
  both.joints = beside.joints;
  both.order = beside.order;
  for (size_t i = 0; i < poses.size(); ++i) {
    const int64_t time = poses.timestamps_us[i];
    const size_t j = std::ranges::lower_bound(beside.timestamps_us, time) - beside.timestamps_us.begin();
    const bool has_both = j < beside.size() && beside.timestamps_us[j] == time &&
                          poses.statuses[i] == TrackStatus::tracked && beside.statuses[j] == TrackStatus::tracked;
    std::vector<double> own;
    if (has_both) {
      const auto other = std::span(beside.numbers).subspan(beside.begins[j], beside.numbers_per_frame());
      const auto pose = std::span(poses.numbers).subspan(poses.begins[i], kPoseNumbers);
      const size_t angles = beside.has.posture ? kAngleCount : 0;
      own.assign(other.begin(), other.begin() + static_cast<ptrdiff_t>(angles));
      own.insert(own.end(), pose.begin(), pose.end());
      if (has_joints) own.insert(own.end(), other.begin() + static_cast<ptrdiff_t>(angles), other.end());
    }
    both.add(time, has_both ? TrackStatus::tracked : TrackStatus::missing, own, where, fmt::format("frame {}", i));
  }
  return both;
}

double meters_of(std::string_view unit, const std::string& flag, const std::string& where,
                 const std::string& field) {
  return factor_of(unit, flag, where, field, {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"none", 1}}, "--units");
}

double microseconds_of(std::string_view unit, const std::string& flag, const std::string& where,
                       const std::string& field) {
  return factor_of(unit, flag, where, field, {{"s", 1e6}, {"ms", 1e3}, {"us", 1}}, "--time-unit");
}

int64_t timestamp_of(double time, double unit_us, const std::string& where, const std::string& field) {
  constexpr double kLongest_us = 1e16;
  const double time_us = time * unit_us;
  if (!(std::abs(time_us) <= kLongest_us))
    throw Error(where, field, fmt::format("{:g}", time), "a time within 300 years of 0");
  return std::llround(time_us);
}

std::array<double, 7> pose_numbers(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

EstimateParts parts_of_joints(std::string_view units, std::string_view frame, const EstimateFlags& flags,
                              const std::string& where) {
  const double is_camera =
      factor_of(frame, flags.frame, where, "frame of the joints", {{"camera", 1}, {"wrist", 0}}, "--frame");
  return {.posture = false, .pose = false, .place = is_camera == 1, .scale = units != "none", .internals = false};
}

}  // namespace glovebench::eval
