#include "core/robot/server/message_age.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace glovebench {
namespace {

constexpr int64_t kGapUs = 100'000;        // between two ticks, or what a clock jumps by
constexpr int64_t kSettleUs = 100'000;     // after a gap: what was underway arrives
constexpr int64_t kStartUs = 200'000;      // of a stream, by both clocks
constexpr int64_t kCatchUpUs = 20'000;     // by which source times may gain on the server's clock during a start
constexpr int64_t kWindowUs = 10'000'000;  // in which the smallest delay counts
constexpr int64_t kBucketUs = 1'000'000;   // of the window: a flood takes no memory
constexpr size_t kMostStreams = 64;

}  // namespace

void MessageAges::Stream::add(int64_t now_us, int64_t delay) {
  if (smallest.empty() || now_us - smallest.back().first >= kBucketUs) smallest.emplace_back(now_us, delay);
  smallest.back().second = std::min(smallest.back().second, delay);
}

void MessageAges::Stream::forget(int64_t now_us) {
  while (!smallest.empty() && now_us - smallest.front().first > kWindowUs + kBucketUs) smallest.pop_front();
  if (smallest.empty()) *this = {};
}

int64_t MessageAges::Stream::smallest_delay() const {
  int64_t result = std::numeric_limits<int64_t>::max();
  for (const auto& [from_us, delay] : smallest) result = std::min(result, delay);
  return result;
}

/// A late message has a longer delay. It has neither a shorter one than all others nor an earlier source time.
bool MessageAges::Stream::jumps(int64_t source, int64_t delay) const {
  if (smallest.empty()) return false;
  return delay < smallest_delay() - kGapUs || (source < source_us && delay > delay_us + kGapUs);
}

MessageAges::MessageAges(double limit_s) : limit_us_(std::llround(limit_s * 1e6)) {}

MessageAges::Stream& MessageAges::stream(const Arrival& arrival, int topic) {
  const std::pair key(arrival.sender, topic);
  if (streams_.size() >= kMostStreams && !streams_.contains(key))
    streams_.erase(std::ranges::min_element(streams_, {}, [](const auto& entry) { return entry.second.heard_us; }));
  return streams_[key];
}

MessageAge MessageAges::judge(const Arrival& arrival, int topic) {
  const int64_t source = arrival.source_ns / 1000, delay = arrival.now_us - source;
  if (settled_us_ && arrival.now_us < *settled_us_) return {.receipt = Receipt::stale};
  Stream& its = stream(arrival, topic);
  its.forget(arrival.now_us);
  MessageAge result;
  result.jumped = its.jumps(source, delay);
  if (result.jumped) its = {};
  its.add(arrival.now_us, delay);
  its.heard_us = arrival.now_us;
  its.source_us = source;
  its.delay_us = delay;
  result.age_us = delay - its.smallest_delay();
  if (result.age_us > limit_us_) {
    result.receipt = Receipt::stale;
    return result;
  }
  // Source times that gain on the server's clock are those of messages that waited: no start is among them.
  if (!its.start || (!its.started && its.start->first - its.start->second - delay > kCatchUpUs))
    its.start = {arrival.now_us, source};
  its.started |= arrival.now_us - its.start->first >= kStartUs && source - its.start->second >= kStartUs;
  if (!its.started) result.receipt = Receipt::starting;
  return result;
}

void MessageAges::begin_anew(int64_t now_us) {
  settled_us_ = now_us + kSettleUs;
  for (auto& [key, its] : streams_) {
    its.start.reset();
    its.started = false;
  }
}

bool MessageAges::watch(int64_t now_us) {
  if (!seen_us_) seen_us_ = now_us;
  if (now_us - *seen_us_ <= kGapUs) return false;
  // The time that the server has missed ages nothing that it knows: so it tells old messages from new ones.
  for (auto& [key, its] : streams_)
    for (auto& [from_us, delay] : its.smallest) from_us += now_us - *seen_us_;
  begin_anew(now_us);
  seen_us_ = now_us;
  return true;
}

bool MessageAges::tick(int64_t now_us, int64_t system_us) {
  bool gap = watch(now_us);
  const int64_t apart_us = system_us - now_us;
  if (apart_us_ && std::abs(apart_us - *apart_us_) > kGapUs) {
    streams_.clear();
    begin_anew(now_us);
    gap = true;
  }
  apart_us_ = apart_us;
  seen_us_ = now_us;
  return gap;
}

}  // namespace glovebench
