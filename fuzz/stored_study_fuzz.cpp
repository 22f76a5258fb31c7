#include "eval/stored_study.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const auto study = eval::study_from_bytes(std::string(fuzz::as_text(data, size)));
    if (!study) return;
    const std::string bytes = eval::to_bytes(*study);
    const auto again = eval::study_from_bytes(bytes);
    check(again && eval::to_bytes(*again) == bytes, "a stored study returns");
  });
}
