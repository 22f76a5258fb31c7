#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "core/robot/server/receipt.h"
#include "core/robot/server/ros_messages.h"

namespace glovebench {

/// Who may command. The first sender of a good message owns all topics of a server; what others send meanwhile is
/// foreign. It owns them until it is gone or has sent nothing good for `release_s`; then the next one does, and
/// stamps begin anew. Within a topic the owner's stamps must rise, or all be zero, which in ROS means now. Reads no
/// clock.
class StreamGate {
 public:
  explicit StreamGate(double release_s);

  /// Of a message that is good in itself. `sender` is any number that is one process's own; `now_us` does not go
  /// back.
  Receipt admit(uint64_t sender, int topic, const ros::Time& stamp, int64_t now_us);
  /// Whether all that `sender` could say now is foreign.
  bool is_foreign(uint64_t sender, int64_t now_us) const;
  /// The senders that are there: an owner that is not among them is gone.
  void keep_only(const std::set<uint64_t>& present);

  /// As if the owner was gone.
  void release() { owner_.reset(); }

  std::optional<uint64_t> owner() const { return owner_; }
  /// How often the stream got an owner.
  int64_t owners() const { return owners_; }

 private:
  int64_t release_us_;
  std::optional<uint64_t> owner_;
  int64_t owners_ = 0;
  int64_t good_us_ = 0;
  std::map<int, int64_t> stamps_ns_;  ///< of the owner's last message on each topic
};

}  // namespace glovebench
