#include "core/base/fuzz_target.h"
#include "reports/estimates.h"

namespace glovebench {

void estimates_fuzz(std::string_view bytes) {
  const std::vector<reports::Estimate> estimates = reports::parse_estimates(std::string(bytes), "estimates.csv");
  const reports::ExperimentEstimates experiment{reports::ExperimentKey(), estimates};
  const std::string text = reports::estimates_csv(experiment);
  check(reports::parse_estimates(text, "again").size() == estimates.size(), "estimates return");
}

}  // namespace glovebench
