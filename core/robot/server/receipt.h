#pragma once

#include <array>
#include <cstdint>

#include "core/base/enum_names.h"

namespace glovebench {

/// What became of a message that a server of the robot received.
enum class Receipt {
  accepted,
  foreign,       ///< another sender owns the stream
  wrong_joints,  ///< its joints are not exactly those of the topic, each once, in any order
  wrong_points,  ///< not exactly one point, or not one position for each joint
  not_finite,    ///< a position is no finite number
  not_rotation,  ///< the quaternion has not the length 1
  wrong_frame,   ///< a pose in another frame than the arm's base
  bad_time,      ///< a time before 1970, or with a second and more of nanoseconds
  went_back,     ///< its stamp is not after that of its sender's last message
  starting,      ///< good, but its stream has not yet shown for 0.2 s that it is a live one
  stale,         ///< good, but older than the time of silence, or it waited through a gap (message_age.h)
};
constexpr auto names_of(Receipt) {
  return std::to_array<std::string_view>({"accepted", "foreign", "wrong_joints", "wrong_points", "not_finite",
                                          "not_rotation", "wrong_frame", "bad_time", "went_back", "starting",
                                          "stale"});
}

/// How often each has happened.
using ReceiptCounts = std::array<int64_t, kCountOf<Receipt>>;

}  // namespace glovebench
