#include "fuzz/fuzz_target.h"
#include "reports/claims/claims_report.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const reports::ClaimSet set = reports::parse_claims(std::string(fuzz::as_text(data, size)), "claims.json");
    check(reports::tampering(set, set).empty(), "a set of claims equals itself");
    const auto verdicts = reports::judge(set.claims, {{"m", "mm", 1.0, {}, false}});
    check(!reports::claims_table(verdicts).empty() && !reports::claims_section(verdicts).empty() &&
              !reports::claims_json(verdicts).empty(),
          "claims can be told");
  });
}
