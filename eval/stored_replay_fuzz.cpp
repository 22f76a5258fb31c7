#include "core/base/fuzz_target.h"
#include "eval/stored_replay.h"

namespace glovebench {

void stored_replay_fuzz(std::string_view bytes) {
  const auto replay = eval::replay_from_bytes(std::string(bytes));
  if (!replay) return;
  const std::string bytes = eval::to_bytes(*replay);
  const auto again = eval::replay_from_bytes(bytes);
  check(again && eval::to_bytes(*again) == bytes, "a stored replay returns");
}

}  // namespace glovebench
