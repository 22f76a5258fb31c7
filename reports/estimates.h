#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/hand/posture.h"
#include "core/tracker/track_result.h"
#include "reports/results.h"

namespace glovebench::reports {

/// A smoothed estimate.
struct Estimate {
  uint64_t seed = 0;
  int frame = 0;
  int64_t timestamp_us = 0;
  TrackStatus status = TrackStatus::no_hand;
  Posture posture = Posture::Zero();                                ///< rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< m
};

struct ExperimentEstimates {
  ExperimentKey key;
  std::vector<Estimate> estimates;  ///< by seed, then frame
};

/// "estimates/EXPERIMENT.csv".
std::string estimates_file(const ExperimentKey& key);
/// Columns: seed, frame, timestamp_us, status, position x y z (mm), quaternion w x y z, 22 angles (deg). To 1e-6,
/// the quaternion to 1e-9. A lost frame has empty cells.
std::string estimates_csv(const ExperimentEstimates& estimates);
/// Without line ends.
std::string estimates_heading();
std::string estimate_csv_line(const Estimate& estimate);
/// Throws: Error.
std::vector<Estimate> read_estimates(const std::string& path);
std::vector<Estimate> parse_estimates(const std::string& text, const std::string& where);
/// Empty if the frame was lost or is not there.
std::optional<HandFrame> find_hand(const std::vector<Estimate>& estimates, uint64_t seed, int frame);

}  // namespace glovebench::reports
