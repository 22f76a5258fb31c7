#include "core/base/fuzz_target.h"
#include "eval/estimates/estimate_format.h"

namespace glovebench {
namespace {

void check_sequence(const eval::EstimateSequence& sequence) {
  for (size_t i = 0; i < sequence.size(); ++i) {
    check(i == 0 || sequence.timestamps_us[i] > sequence.timestamps_us[i - 1], "times increase");
    const TrackResult answer = sequence.answer(i);
    check(answer.posture.allFinite() && answer.T_camera_hand.matrix().allFinite(), "an answer is finite");
    for (const auto& joint : answer.joints) check(!joint || joint->allFinite(), "a joint is finite");
  }
}

}  // namespace

void estimate_formats_fuzz(std::string_view bytes) {
  const eval::EstimateFlags given = {eval::joint_orders().front(), "mm", "camera", "s"};
  for (const eval::EstimateFormat& format : eval::estimate_formats())
    for (const eval::EstimateFlags& flags : {eval::EstimateFlags(), given})
      expect_value_or_error([&] {
        for (const eval::EstimateSequence& sequence : format.read(bytes, flags, "estimates"))
          check_sequence(sequence);
      });
  expect_value_or_error([&] { eval::parse_joint_map(bytes, "map.json"); });
}

}  // namespace glovebench
