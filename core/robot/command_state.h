#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/base/enum_names.h"

namespace glovebench {

/// What the robot shall do with a command.
enum class CommandState {
  following,  ///< go to the targets
  holding,    ///< the hand is not seen: stay at the targets, those of the last line that was sent
  stopped,    ///< it has not been seen for too long: stay, and expect a slow start
};
constexpr auto names_of(CommandState) {
  return std::to_array<std::string_view>({"following", "holding", "stopped"});
}
static_assert(kCountOf<CommandState> == static_cast<int>(CommandState::stopped) + 1, "each value has a name");

/// Why a command is not what was asked for.
enum class Intervention {
  stale,              ///< dropped: its time stamp, or its frame's, is not after the last one
  not_finite,         ///< refused: a value is not finite
  not_rigid,          ///< refused: the pose's rotation is none
  joint_limit,        ///< a joint of the hand was moved into its limits, or J1 under J2
  coupling,           ///< J1 and J2 of a finger were not as their motor moves them, and were made anew
  actuator_mismatch,  ///< the targets of the motors were not those of the joints, and were made anew
  joint_speed,        ///< a joint of the hand was slowed down
  workspace,          ///< the hand was moved into the workspace, with its fingertips
  hand_speed,         ///< the hand's motion was slowed down
  hand_turn_speed,    ///< the hand's turning was slowed down
  fingertip_speed,    ///< a fingertip was slowed down
  arm_limit,          ///< a joint of the arm was moved into its limits
  arm_speed,          ///< a joint of the arm was slowed down
  arm_unreachable,    ///< the arm has no joint angles for the pose, or none near the last ones: they are kept
  hold,               ///< the targets were held
  stop,               ///< the stream came to a stop
};
constexpr auto names_of(Intervention) {
  return std::to_array<std::string_view>({"stale", "not_finite", "not_rigid", "joint_limit", "coupling",
                                          "actuator_mismatch", "joint_speed", "workspace", "hand_speed",
                                          "hand_turn_speed", "fingertip_speed", "arm_limit", "arm_speed",
                                          "arm_unreachable", "hold", "stop"});
}
static_assert(kCountOf<Intervention> == static_cast<int>(Intervention::stop) + 1, "each value has a name");

/// How often each kind happened. A kind counts once a command, however many joints it concerns.
class Interventions {
 public:
  int64_t operator[](Intervention kind) const { return counts_[static_cast<size_t>(kind)]; }
  /// Saturates at INT64_MAX; less than one adds nothing.
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
