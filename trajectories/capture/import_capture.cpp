#include "trajectories/capture/import_capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/pose/horn.h"
#include "trajectories/generation/low_dispersion.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr uint64_t kLargestCapture = uint64_t{256} << 20;  // an hour of a hand's markers at 120 Hz

MarkerSequence mirrored(MarkerSequence sequence) {
  for (MarkerFrame& frame : sequence.frames)
    for (Eigen::Vector3d& p : frame.points) p.x() = -p.x();
  return sequence;
}

/// The pose of the left hand whose mirror image has this pose.
Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T) {
  const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = mirror * T.linear() * mirror;
  result.translation() = mirror * T.translation();
  return result;
}

MarkerSequence load_captures(const std::vector<std::string>& paths, const Format& format, Side side) {
  constexpr int64_t step_us = 1'000'000;
  MarkerSequence all;
  for (const std::string& path : paths) {
    MarkerSequence sequence = format.markers(read_file(path, kLargestCapture), side, path);
    if (all.frames.empty()) {
      all = std::move(sequence);
      continue;
    }
    if (sequence.names != all.names) throw Error(path, "points", "other names", "those of " + paths.front());
    const int64_t begin = all.frames.back().timestamp_us + step_us;
    for (MarkerFrame& frame : sequence.frames) {
      frame.timestamp_us += begin;
      all.frames.push_back(std::move(frame));
    }
  }
  return all;
}

/// The mean position and rotation of poses.
Eigen::Isometry3d mean_pose(const std::vector<Eigen::Isometry3d>& poses) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (const Eigen::Isometry3d& T : poses) {
    const Eigen::Vector4d q = Eigen::Quaterniond(T.linear()).coeffs();
    sum += q * q.transpose();
    position += T.translation() / static_cast<double>(poses.size());
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(largest_eigenvector(sum)).normalized().toRotationMatrix();
  T.translation() = position;
  return T;
}

std::vector<double> all_residuals(const HandFit& fit) {
  std::vector<double> all;
  for (const FittedFrame& frame : fit.frames) all.insert(all.end(), frame.residuals.begin(), frame.residuals.end());
  return all;
}

std::string names_of(const std::array<bool, kAngleCount>& angles) {
  std::string names;
  for (size_t a = 0; a < kAngleCount; ++a)
    if (angles[a]) names += fmt::format("{}{}", names.empty() ? "" : " ", angle_infos()[a].name);
  return names;
}

std::string millimetres(const std::optional<double>& metres) { return metres ? fixed(1000 * *metres, 2) : ""; }

}  // namespace

HandFit import_capture(const std::vector<std::string>& paths, const Format& format, Side side,
                       const MarkerLayout& layout, const HandModel& right_hand) {
  if (paths.empty()) throw Error("capture", "files", "none", "at least one");
  MarkerSequence sequence = load_captures(paths, format, side);
  if (side == Side::left) sequence = mirrored(std::move(sequence));
  const std::string& where = paths.front();
  return fit_hand(sequence, place_markers(sequence.names, layout, right_hand, where), right_hand.skeleton(), where);
}

Trajectory trajectory_of(const HandFit& fit, const CapturePlacement& placement, const std::string& name,
                         int every) {
  Trajectory trajectory;
  trajectory.name = name;
  trajectory.description = "motion capture: " + summary(fit);
  trajectory.side = placement.side;
  std::vector<Eigen::Isometry3d> poses;  // in the capture's frame
  for (size_t f = 0; f < fit.frames.size(); f += static_cast<size_t>(every)) {
    const FittedFrame& frame = fit.frames[f];
    if (frame.left_out) continue;
    const Eigen::Isometry3d& T = frame.state.T_capture_hand;
    poses.push_back(placement.side == Side::left ? mirrored(T) : T);
    trajectory.frames.push_back({frame.timestamp_us, frame.state.posture, {}});
  }
  if (poses.empty()) throw Error("import", "frames", "none with a pose", "at least one");
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.linear() = hand_rotation(0, 0, 0).toRotationMatrix();
  T_camera_hand.translation().z() = kViewingDistance;
  const Eigen::Isometry3d T_camera_capture = placement.T_capture_camera
                                                 ? placement.T_capture_camera->inverse()
                                                 : T_camera_hand * mean_pose(poses).inverse();
  for (size_t f = 0; f < poses.size(); ++f) trajectory.frames[f].T_camera_hand = T_camera_capture * poses[f];
  return trajectory;
}

PostureSet postures_of(const HandFit& fit, const std::string& name, size_t count,
                       const std::vector<std::string>& names) {
  std::vector<Posture> pool;
  std::vector<std::string> pool_names;
  for (size_t f = 0; f < fit.frames.size(); ++f) {
    if (fit.frames[f].left_out) continue;
    pool.push_back(fit.frames[f].state.posture);
    pool_names.push_back(names.empty() ? fmt::format("frame_{}", f) : names.at(f));
  }
  std::vector<size_t> chosen(pool.size());
  std::iota(chosen.begin(), chosen.end(), 0U);
  if (count < pool.size()) {
    const std::vector<Posture> others(pool.begin() + 1, pool.end());
    chosen = {0};
    for (const size_t p : low_dispersion_sample(others, {pool.front()}, count - 1)) chosen.push_back(p + 1);
  }
  PostureSet set{.name = name, .posture_names = {}, .postures = {}};
  for (const size_t p : chosen) {
    set.posture_names.push_back(pool_names[p]);
    set.postures.push_back(pool[p]);
  }
  return set;
}

std::string residual_table(const HandFit& fit) {
  std::string text =
      "frame,timestamp_us,points,residual_median_mm,residual_max_mm,labels_corrected,pose,bridged_angles\n";
  for (size_t f = 0; f < fit.frames.size(); ++f) {
    const FittedFrame& frame = fit.frames[f];
    text += fmt::format("{},{},{},{},{},{},{},{}\n", f, frame.timestamp_us, frame.points,
                        millimetres(quantile_of(frame.residuals, 0.5)),
                        millimetres(quantile_of(frame.residuals, 1)), frame.labels_corrected,
                        frame.left_out       ? "left out"
                        : frame.bridged_pose ? "bridged"
                                             : "fitted",
                        names_of(frame.bridged_angles));
  }
  return text;
}

std::string summary(const HandFit& fit) {
  const auto count = [&](auto member) { return std::ranges::count_if(fit.frames, member); };
  int corrected = 0;
  for (const FittedFrame& frame : fit.frames) corrected += frame.labels_corrected;
  const auto left_out = count(&FittedFrame::left_out), bridged = count(&FittedFrame::bridged_pose) - left_out;
  const std::vector<double> residuals = all_residuals(fit);
  const std::string never = names_of(fit.never_shown);
  return fmt::format(
      "{} frames, {} left out; residual {} mm (median), {} mm (95%); {} points missing, {} gaps of angles and {} "
      "poses "
      "bridged; {} labels corrected; {}",
      fit.frames.size(), left_out, millimetres(quantile_of(residuals, 0.5)),
      millimetres(quantile_of(residuals, 0.95)), fit.missing_points, fit.angle_gaps, bridged, corrected,
      never.empty() ? "every angle is shown" : "not shown: " + never);
}

}  // namespace glovebench::trajectories
