#include "fuzz/fuzz_target.h"
#include "reports/estimates.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const std::vector<reports::Estimate> estimates =
        reports::parse_estimates(std::string(fuzz::as_text(data, size)), "estimates.csv");
    const reports::ExperimentEstimates experiment{reports::ExperimentKey(), estimates};
    const std::string text = reports::estimates_csv(experiment);
    check(reports::parse_estimates(text, "again").size() == estimates.size(), "estimates return");
  });
}
