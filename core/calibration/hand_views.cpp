#include "core/calibration/hand_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/math.h"

namespace glovebench::calibration {
namespace {

constexpr int kLeastViews = 30;
constexpr double kLeastBend_deg = 60, kLeastTurn_deg = 40;
constexpr double kOutliers = 0.05;  ///< of the views at either end of a range

/// The two joints of each finger whose bending counts.
constexpr std::array<std::array<int, 2>, 5> kBending = {{{kThumbMcpFlexion, kThumbIpFlexion},
                                                         {kIndexMcpFlexion, kIndexPipFlexion},
                                                         {kMiddleMcpFlexion, kMiddlePipFlexion},
                                                         {kRingMcpFlexion, kRingPipFlexion},
                                                         {kLittleMcpFlexion, kLittlePipFlexion}}};

double range_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const auto cut = static_cast<size_t>(kOutliers * static_cast<double>(values.size()));
  return values[values.size() - 1 - cut] - values[cut];
}

}  // namespace

Eigen::Vector3d view_direction(const ArticulatedPose& pose) {
  return -(pose.T_camera_hand.linear().transpose() * pose.T_camera_hand.translation()).normalized();
}

std::optional<TrackedView> view_of(const DeviceFrame& frame, const TrackResult& result,
                                   const MethodInputs& inputs) {
  if (result.status != TrackStatus::tracked) return {};
  const Sighting seen = see_in_reach(frame, inputs.calibration, *inputs.table, inputs.config, unobserved);
  if (seen.status != TrackStatus::tracked) return {};  // a cut hand, followed
  TrackedView view;
  view.timestamp_us = frame.depth_timestamp_us;
  view.pose = {result.posture_unfiltered, result.T_camera_hand_unfiltered};
  view.seen.assign(seen, frame, inputs.config.volume);
  return view;
}

ShownMotion motion_of(std::span<const TrackedView> views) {
  ShownMotion motion;
  motion.views = static_cast<int>(views.size());
  if (views.empty()) return motion;
  motion.seconds = 1e-6 * static_cast<double>(views.back().timestamp_us - views.front().timestamp_us);
  double least_cosine = 1;
  for (const TrackedView& a : views)
    for (const TrackedView& b : views)
      least_cosine = std::min(least_cosine, view_direction(a.pose).dot(view_direction(b.pose)));
  motion.turn_deg = degrees_from_radians(std::acos(std::max(-1.0, least_cosine)));
  for (size_t finger = 0; finger < kBending.size(); ++finger) {
    std::vector<double> bends;
    for (const TrackedView& view : views) {
      const auto [first, second] = kBending[finger];
      bends.push_back(degrees_from_radians(view.pose.posture[first] + view.pose.posture[second]));
    }
    motion.bend_deg[finger] = range_of(bends);
  }
  return motion;
}

void require_motion(const ShownMotion& motion, const std::string& where) {
  if (motion.views < kLeastViews)
    throw Error(where, "tracked frames", fmt::format("{}", motion.views),
                fmt::format("at least {}: a recording of about 10 s", kLeastViews));
  const auto& bends = motion.bend_deg;
  const double median = [&] {
    std::array<double, 5> sorted = bends;
    std::ranges::sort(sorted);
    return sorted[2];
  }();
  if (median < kLeastBend_deg)
    throw Error(where, "movement of the fingers", fmt::format("{:.0f} degrees", median),
                fmt::format("at least {:.0f}: a hand that opens and closes", kLeastBend_deg));
  if (motion.turn_deg < kLeastTurn_deg)
    throw Error(where, "turn of the hand", fmt::format("{:.0f} degrees", motion.turn_deg),
                fmt::format("at least {:.0f}: a hand that turns", kLeastTurn_deg));
}

}  // namespace glovebench::calibration
