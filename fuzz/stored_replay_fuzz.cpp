#include "eval/stored_replay.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const auto replay = eval::replay_from_bytes(std::string(fuzz::as_text(data, size)));
    if (!replay) return;
    const std::string bytes = eval::to_bytes(*replay);
    const auto again = eval::replay_from_bytes(bytes);
    check(again && eval::to_bytes(*again) == bytes, "a stored replay returns");
  });
}
