#include "eval/regression/baseline.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error(
      [&] { eval::parse_provenance(std::string(fuzz::as_text(data, size)), "provenance.json"); });
}
