#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/base/enum_names.h"

namespace glovebench {

enum class CommandState {
  following,  ///< moves to the targets
  holding,    ///< hand lost: stays
  stopped,    ///< lost for long: stays, later starts slowly
};
constexpr auto names_of(CommandState) {
  return std::to_array<std::string_view>({"following", "holding", "stopped"});
}
static_assert(kCountOf<CommandState> == static_cast<int>(CommandState::stopped) + 1, "each value has a name");

/// Changes of a command. `_speed`: slowed to that limit.
enum class Intervention {
  stale,        ///< dropped: time stamp not later, or frame's time stamp earlier
  not_finite,   ///< refused
  not_rigid,    ///< refused
  joint_limit,  ///< moved into its limits, or J1 down to J2
  coupling,
  actuator_mismatch,  ///< motors did not fit joints
  joint_speed,
  workspace,  ///< hand or fingertips moved inside
  hand_speed,
  hand_turn_speed,
  fingertip_speed,
  arm_limit,
  arm_speed,
  arm_unreachable,  ///< no joint angles near the last, which stay
  hold,
  stop,
};
constexpr auto names_of(Intervention) {
  return std::to_array<std::string_view>({"stale", "not_finite", "not_rigid", "joint_limit", "coupling",
                                          "actuator_mismatch", "joint_speed", "workspace", "hand_speed",
                                          "hand_turn_speed", "fingertip_speed", "arm_limit", "arm_speed",
                                          "arm_unreachable", "hold", "stop"});
}
static_assert(kCountOf<Intervention> == static_cast<int>(Intervention::stop) + 1, "each value has a name");

/// Commands by kind.
class Interventions {
 public:
  int64_t operator[](Intervention kind) const { return counts_[static_cast<size_t>(kind)]; }
  /// Saturates at INT64_MAX. Ignores counts below 1.
  void add(Intervention kind, int64_t count = 1) {
    int64_t& sum = counts_[static_cast<size_t>(kind)];
    if (count > 0) sum += std::min(count, std::numeric_limits<int64_t>::max() - sum);
  }
  void add(const Interventions& others) {
    for (const Intervention kind : all_values<Intervention>()) add(kind, others[kind]);
  }
  bool none() const { return *this == Interventions(); }
  bool operator==(const Interventions&) const = default;

 private:
  std::array<int64_t, kCountOf<Intervention>> counts_{};
};

}  // namespace glovebench
