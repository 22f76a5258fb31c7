#include "core/robot/command_state.h"

#include <algorithm>
#include <limits>

namespace glovebench {

std::string_view to_string(CommandState state) {
  static constexpr std::array<std::string_view, kCommandStateCount> names = {"following", "holding", "stopped"};
  return names.at(static_cast<size_t>(state));
}

std::string_view to_string(Intervention intervention) {
  static constexpr std::array<std::string_view, kInterventionCount> names = {"stale",
                                                                             "not_finite",
                                                                             "not_rigid",
                                                                             "joint_limit",
                                                                             "coupling",
                                                                             "actuator_mismatch",
                                                                             "joint_speed",
                                                                             "workspace",
                                                                             "hand_speed",
                                                                             "hand_turn_speed",
                                                                             "fingertip_speed",
                                                                             "arm_limit",
                                                                             "arm_speed",
                                                                             "arm_unreachable",
                                                                             "hold",
                                                                             "stop"};
  return names.at(static_cast<size_t>(intervention));
}

void Interventions::add(Intervention kind, int64_t count) {
  if (count < 1) return;
  int64_t& sum = counts_[static_cast<size_t>(kind)];
  sum += std::min(count, std::numeric_limits<int64_t>::max() - sum);
}

void Interventions::add(const Interventions& others) {
  for (int i = 0; i < kInterventionCount; ++i) {
    const auto kind = static_cast<Intervention>(i);
    add(kind, others[kind]);
  }
}

}  // namespace glovebench
