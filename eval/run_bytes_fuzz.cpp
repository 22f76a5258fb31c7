#include "core/base/fuzz_target.h"
#include "eval/run_bytes.h"

namespace glovebench {

void run_bytes_fuzz(std::string_view bytes) {
  const auto run = eval::run_from_bytes(std::string(bytes), {});
  if (!run) return;
  const std::string written = eval::to_bytes(*run);
  const auto again = eval::run_from_bytes(written, {});
  check(again && eval::to_bytes(*again) == written, "a stored run returns");
}

}  // namespace glovebench
