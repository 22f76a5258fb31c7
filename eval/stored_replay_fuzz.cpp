#include "core/base/fuzz_target.h"
#include "eval/stored_replay.h"

namespace glovebench {

void stored_replay_fuzz(std::string_view bytes) {
  const auto replay = eval::replay_from_bytes(std::string(bytes));
  if (!replay) return;
  const std::string written = eval::to_bytes(*replay);
  const auto again = eval::replay_from_bytes(written);
  check(again && eval::to_bytes(*again) == written, "a stored replay returns");
}

}  // namespace glovebench
