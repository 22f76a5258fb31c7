#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace glovebench {

/// What the robot shall do with a command.
enum class CommandState {
  following,  ///< go to the targets
  holding,    ///< the hand is not seen: stay at the targets, those of the last line that was sent
  stopped,    ///< it has not been seen for too long: stay, and expect a slow start
};
inline constexpr int kCommandStateCount = 3;
std::string_view to_string(CommandState state);

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
inline constexpr int kInterventionCount = 16;
std::string_view to_string(Intervention intervention);

/// How often each kind happened. A kind counts once a command, however many joints it concerns.
class Interventions {
 public:
  int64_t operator[](Intervention kind) const { return counts_[static_cast<size_t>(kind)]; }
  /// Saturates at INT64_MAX; less than one adds nothing.
  void add(Intervention kind, int64_t count = 1);
  void add(const Interventions& others);
  bool none() const { return *this == Interventions(); }
  bool operator==(const Interventions&) const = default;

 private:
  std::array<int64_t, kInterventionCount> counts_{};
};

}  // namespace glovebench
