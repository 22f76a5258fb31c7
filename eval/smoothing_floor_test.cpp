#include <gmock/gmock.h>

#include "core/base/math.h"
#include "core/tracker/smoothing.h"
#include "eval/program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

/// Mean posture error (RMS over 22 angles, degrees) of the paper's filter on a recorded truth with perfect
/// look-ups.
double filter_only_error_deg(const std::string& name) {
  const trajectories::Trajectory truth = trajectories::recorded_trajectory(trajectory_folder(), name);
  std::vector<TrackResult> results;
  double sum = 0;
  for (const HandFrame& frame : truth.frames) {
    TrackResult result;
    result.status = TrackStatus::tracked;
    result.posture_unfiltered = frame.posture;
    results.push_back(smoothed(result, results, {}));
    sum += degrees_from_radians(posture_distance(results.back().posture, frame.posture));
  }
  return sum / static_cast<double>(truth.frames.size());
}

TEST(SmoothingFloor, the_filter_alone_costs_tr4_more_than_the_papers_posture_error) {
  // Two full transitions of 57 degrees, seen three frames late, are 2 * 57 * 3 / 117 = 2.9 degrees per frame. The
  // README quotes this beside the paper's 2.60, which is for another movement.
  const double error = filter_only_error_deg("Tr4");
  RecordProperty("filter_only_error_deg", std::to_string(error));
  EXPECT_THAT(error, testing::AllOf(testing::Gt(2.6), testing::Lt(3.1)));
}

}  // namespace
}  // namespace glovebench::eval
