#include "eval/estimates/estimate_format.h"
#include "reports/estimates.h"

namespace glovebench::eval {
namespace {

std::vector<double> numbers_of(const reports::Estimate& estimate) {
  std::vector<double> numbers(estimate.posture.begin(), estimate.posture.end());
  const auto pose = pose_numbers(estimate.T_camera_hand);
  numbers.insert(numbers.end(), pose.begin(), pose.end());
  return numbers;
}

/// estimates/*.csv of a report, with all its seeds.
std::vector<EstimateSequence> read_run(std::string_view bytes, const EstimateFlags&, const std::string& where) {
  std::vector<EstimateSequence> sequences;
  for (const reports::Estimate& estimate : reports::parse_estimates(std::string(bytes), where)) {
    if (sequences.empty() || sequences.back().seed != estimate.seed) sequences.emplace_back().seed = estimate.seed;
    sequences.back().add(estimate.timestamp_us, estimate.status, numbers_of(estimate), where,
                         "frame " + std::to_string(estimate.frame));
  }
  return sequences;
}

}  // namespace

EstimateFormat run_estimates() {
  return {.name = "run",
          .description = "estimates/*.csv of `glovebench run`, *.csv of `glovebench track`",
          .fits = [](std::string_view, std::string_view first_line) { return first_line.starts_with("seed,"); },
          .read = read_run};
}

}  // namespace glovebench::eval
