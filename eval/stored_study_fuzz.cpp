#include "core/base/fuzz_target.h"
#include "eval/run_bytes.h"

namespace glovebench {

void stored_study_fuzz(std::string_view bytes) {
  const auto study = eval::study_from_bytes(std::string(bytes));
  if (!study) return;
  const std::string written = eval::to_bytes(*study);
  const auto again = eval::study_from_bytes(written);
  check(again && eval::to_bytes(*again) == written, "a stored study returns");
}

}  // namespace glovebench
