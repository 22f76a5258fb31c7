#include "core/adapters/dds/server/command_stream.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace glovebench {
namespace {

constexpr int64_t kGapUs = 100'000;        // between two ticks, or of a clock's jump
constexpr int64_t kSettleUs = 100'000;     // after a gap, for messages under way
constexpr int64_t kStartUs = 200'000;      // of a stream, by both clocks
constexpr int64_t kCatchUpUs = 20'000;     // that source times may gain on the server's clock during a start
constexpr int64_t kWindowUs = 10'000'000;  // for the smallest delay
constexpr int64_t kBucketUs = 1'000'000;   // part of the window; bounds the memory
constexpr size_t kMostStreams = 64;
constexpr int64_t kPaceUs = 500'000;  // over which the pace is measured: a short recording is over in a second

int64_t whole_us(double seconds) { return std::llround(seconds * 1e6); }

}  // namespace

void CommandStream::Delays::forget(int64_t now_us) {
  while (!smallest.empty() && now_us - smallest.front().first > kWindowUs + kBucketUs) smallest.pop_front();
  if (smallest.empty()) *this = {};
}

int64_t CommandStream::Delays::smallest_delay() const {
  int64_t result = std::numeric_limits<int64_t>::max();
  for (const auto& [from_us, delay] : smallest) result = std::min(result, delay);
  return result;
}

/// A late message has a longer delay. It has neither a shorter one than all others nor an earlier source time.
bool CommandStream::Delays::jumps(int64_t source, int64_t delay) const {
  if (smallest.empty()) return false;
  return delay < smallest_delay() - kGapUs || (source < source_us && delay > delay_us + kGapUs);
}

void CommandStream::Delays::add(int64_t now_us, int64_t source, int64_t delay) {
  if (smallest.empty() || now_us - smallest.back().first >= kBucketUs) smallest.emplace_back(now_us, delay);
  smallest.back().second = std::min(smallest.back().second, delay);
  heard_us = now_us;
  source_us = source;
  delay_us = delay;
}

CommandStream::CommandStream(const CommandLimits& limits, int topics)
    : silence_us_(whole_us(limits.silence_s)),
      release_us_(whole_us(limits.stop_after_s)),
      stamps_ns_(static_cast<size_t>(topics)),
      until_us_(static_cast<size_t>(topics)),
      paced_from_(static_cast<size_t>(topics)) {}

bool CommandStream::ignores(uint64_t sender, int64_t now_us) {
  watch(now_us);
  const bool foreign = is_foreign(sender, now_us);
  receipts_[static_cast<size_t>(Receipt::foreign)] += foreign;
  return foreign;
}

Receipt CommandStream::receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found) {
  const Receipt receipt = found == Receipt::accepted ? judge(arrival, topic, stamp) : found;
  ++receipts_[static_cast<size_t>(receipt)];
  return receipt;
}

Receipt CommandStream::judge(const Arrival& arrival, int topic, const ros::Time& stamp) {
  auto [receipt, age_us] = judge_age(arrival, topic);
  if (receipt == Receipt::accepted) receipt = judge_order(arrival, topic, stamp);
  if (receipt == Receipt::accepted)
    until_us_.at(static_cast<size_t>(topic)) = arrival.now_us - age_us + silence_us_;
  return receipt;
}

/// Also returns the age of the message, us.
std::pair<Receipt, int64_t> CommandStream::judge_age(const Arrival& arrival, int topic) {
  const int64_t source = arrival.source_ns / 1000, delay = arrival.now_us - source;
  if (settled_us_ && arrival.now_us < *settled_us_) return {Receipt::stale, 0};
  Delays& its = delays(arrival.sender, topic);
  its.forget(arrival.now_us);
  if (its.jumps(source, delay)) {
    its = {};
    if (owner_ == arrival.sender) lose_owner();
  }
  its.add(arrival.now_us, source, delay);
  const int64_t age_us = delay - its.smallest_delay();
  if (age_us > silence_us_) return {Receipt::stale, age_us};
  // Source times that gain on the server's clock belong to messages that waited: the start begins anew.
  if (!its.start || (!its.started && its.start->first - its.start->second - delay > kCatchUpUs))
    its.start = {arrival.now_us, source};
  its.started |= arrival.now_us - its.start->first >= kStartUs && source - its.start->second >= kStartUs;
  return {its.started ? Receipt::accepted : Receipt::starting, age_us};
}

Receipt CommandStream::judge_order(const Arrival& arrival, int topic, const ros::Time& stamp) {
  if (is_foreign(arrival.sender, arrival.now_us)) return Receipt::foreign;
  if (!owner_ || arrival.now_us - good_us_ > release_us_) {
    owner_ = arrival.sender;
    ++owners_;
    std::ranges::fill(stamps_ns_, std::nullopt);
    std::ranges::fill(until_us_, std::nullopt);  // the last owner's goals end
    std::ranges::fill(paced_from_, std::nullopt);
  }
  const int64_t stamp_ns = nanoseconds(stamp);
  std::optional<int64_t>& last_ns = stamps_ns_.at(static_cast<size_t>(topic));
  const bool unstamped = stamp_ns == 0 && last_ns == 0;
  if (last_ns && stamp_ns <= *last_ns && !unstamped) return Receipt::went_back;
  last_ns = stamp_ns;
  good_us_ = arrival.now_us;
  measure_pace(arrival.now_us, topic, stamp_ns);
  return Receipt::accepted;
}

void CommandStream::measure_pace(int64_t now_us, int topic, int64_t stamp_ns) {
  std::optional<std::pair<int64_t, int64_t>>& from = paced_from_.at(static_cast<size_t>(topic));
  if (from && now_us - from->first < kPaceUs) return;
  if (from)
    pace_ = std::max(
        pace_, 1e-3 * static_cast<double>(stamp_ns - from->second) / static_cast<double>(now_us - from->first));
  from = {now_us, stamp_ns};
}

bool CommandStream::is_foreign(uint64_t sender, int64_t now_us) const {
  return owner_ && *owner_ != sender && now_us - good_us_ <= release_us_;
}

CommandStream::Delays& CommandStream::delays(uint64_t sender, int topic) {
  const std::pair key(sender, topic);
  if (delays_.size() >= kMostStreams && !delays_.contains(key))
    delays_.erase(std::ranges::min_element(delays_, {}, [](const auto& entry) { return entry.second.heard_us; }));
  return delays_[key];
}

void CommandStream::tick(const ServerTime& now) {
  const int64_t apart_us = now.system_us - now.clock_us;
  const bool is_set = apart_us_ && std::abs(apart_us - *apart_us_) > kGapUs;
  if (is_set) delays_.clear();
  if (!watch(now.clock_us) && is_set) begin_gap(now.clock_us);
  apart_us_ = apart_us;
  seen_us_ = now.clock_us;
}

/// Call at each reception and tick. Returns whether a gap has just ended.
bool CommandStream::watch(int64_t now_us) {
  if (!seen_us_) seen_us_ = now_us;
  const int64_t missed_us = now_us - *seen_us_;
  if (missed_us <= kGapUs) return false;
  // Delays do not age during the gap, so old messages can still be told from new ones.
  for (auto& [key, its] : delays_)
    for (auto& [from_us, delay] : its.smallest) from_us += missed_us;
  begin_gap(now_us);
  seen_us_ = now_us;
  return true;
}

void CommandStream::begin_gap(int64_t now_us) {
  settled_us_ = now_us + kSettleUs;
  for (auto& [key, its] : delays_) {
    its.start.reset();
    its.started = false;
  }
  lose_owner();
}

void CommandStream::lose_owner() {
  ++gaps_;
  owner_.reset();
  std::ranges::fill(until_us_, std::nullopt);
}

bool CommandStream::is_current(int topic, int64_t now_us) const {
  const std::optional<int64_t>& until_us = until_us_.at(static_cast<size_t>(topic));
  return until_us && now_us <= *until_us;
}

bool CommandStream::is_current(int64_t now_us) const {
  return std::ranges::any_of(until_us_, [&](const auto& until_us) { return until_us && now_us <= *until_us; });
}

void CommandStream::keep_only(const std::set<uint64_t>& present) {
  if (owner_ && !present.contains(*owner_)) owner_.reset();
}

}  // namespace glovebench
