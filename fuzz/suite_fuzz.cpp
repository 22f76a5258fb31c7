#include "eval/suite.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const eval::Suite suite = eval::parse_suite(fuzz::as_text(data, size), "suite.json");
    check(!suite.seeds.empty() && !suite.entries.empty(), "a suite has seeds and experiments");
  });
}
