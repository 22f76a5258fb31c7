#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "eval/estimates/compared_points.h"
#include "eval/estimates/estimate_format.h"

namespace glovebench::eval {

/// The estimate of each frame of the truth, with the frame's time stamp.
struct TimeMatch {
  std::vector<TrackResult> answers;  ///< `missing` without an estimate
  int missing = 0;
  int unmatched = 0;     ///< estimates that match no frame
  bool is_exact = true;  ///< all time stamps are equal
};
/// Half the median time between frames, us.
int64_t default_tolerance_us(std::span<const HandFrame> truth);
/// The nearest estimate within the tolerance; each counts once. `offset_us` is added to the estimates' time stamps.
/// Throws: Error if no frame has one.
TimeMatch match_times(std::span<const HandFrame> truth, const EstimateSequence& estimates, int64_t offset_us,
                      int64_t tolerance_us, const std::string& where);

/// What to add to the estimates' time stamps, us, with the ends of its 95% interval: a bootstrap over blocks of a
/// second.
struct TimeOffset {
  double offset_us = 0, low_us = 0, high_us = 0;
};
/// The offset within a second of 0, or of equal starts if the times do not overlap, with the least mean
/// square distance from the interpolated truth, by a parabola.
/// Throws: Error with fewer than 10 tracked estimates there, or if the distance is least at an end.
TimeOffset estimate_offset(const PointComparison& comparison, std::span<const HandFrame> truth,
                           const std::vector<Points>& true_points, const EstimateSequence& estimates,
                           const std::string& where);

/// Rows of randomly drawn blocks, as many as there are.
std::vector<Eigen::Index> drawn_rows(Eigen::Index count, Eigen::Index block, int draw);

}  // namespace glovebench::eval
