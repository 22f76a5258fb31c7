#include "fuzz/fuzz_target.h"
#include "reports/results_json.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const std::string text =
        reports::results_json(reports::parse_results(std::string(fuzz::as_text(data, size)), "results.json"));
    check(reports::results_json(reports::parse_results(text, "again")) == text, "results return");
  });
}
