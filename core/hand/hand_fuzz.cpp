#include "core/base/fuzz_target.h"
#include "core/hand/hand_file.h"

namespace glovebench {

void hand_fuzz(std::string_view bytes) {
  const MeasuredHand hand = parse_hand(bytes, "hand.json");
  const std::string written = hand_text(hand);
  check(hand_text(parse_hand(written, "again")) == written, "a hand returns");
}

}  // namespace glovebench
