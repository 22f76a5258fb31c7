#include <nlohmann/json.hpp>

#include "core/base/fuzz_target.h"
#include "core/hand/hand_file.h"

namespace glovebench {

void hand_fuzz(std::string_view bytes) {
  const MeasuredHand hand = parse_hand(bytes, "hand.json");
  const nlohmann::ordered_json written = to_json(hand);
  check(to_json(parse_hand(written.dump(), "again")) == written, "a hand returns");
}

}  // namespace glovebench
