#include "core/base/fuzz_target.h"
#include "reports/results_json.h"

namespace glovebench {

void results_fuzz(std::string_view bytes) {
  const std::string text = reports::results_json(reports::parse_results(std::string(bytes), "results.json"));
  check(reports::results_json(reports::parse_results(text, "again")) == text, "results return");
}

}  // namespace glovebench
