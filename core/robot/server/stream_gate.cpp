#include "core/robot/server/stream_gate.h"

#include <cmath>

#include "core/robot/server/command_messages.h"

namespace glovebench {

StreamGate::StreamGate(double release_s) : release_us_(std::llround(release_s * 1e6)) {}

Receipt StreamGate::admit(uint64_t sender, int topic, const ros::Time& stamp, int64_t now_us) {
  if (is_foreign(sender, now_us)) return Receipt::foreign;
  if (!owner_ || now_us - good_us_ > release_us_) {
    owner_ = sender;
    ++owners_;
    stamps_ns_.clear();
  }
  const int64_t stamp_ns = nanoseconds(stamp);
  const auto last = stamps_ns_.find(topic);
  const bool unstamped = stamp_ns == 0 && last != stamps_ns_.end() && last->second == 0;
  if (last != stamps_ns_.end() && stamp_ns <= last->second && !unstamped) return Receipt::went_back;
  stamps_ns_[topic] = stamp_ns;
  good_us_ = now_us;
  return Receipt::accepted;
}

bool StreamGate::is_foreign(uint64_t sender, int64_t now_us) const {
  return owner_ && *owner_ != sender && now_us - good_us_ <= release_us_;
}

void StreamGate::keep_only(const std::set<uint64_t>& present) {
  if (owner_ && !present.contains(*owner_)) owner_.reset();
}

}  // namespace glovebench
