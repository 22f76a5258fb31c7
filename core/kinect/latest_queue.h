#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace glovebench {

/// The newest values, oldest first. Dropped values count as late after the first `pop`. Not thread-safe.
template <typename T>
class LatestQueue {
 public:
  explicit LatestQueue(size_t capacity) : capacity_(capacity) {}

  void push(T value) { values_.push_back(std::move(value)); }
  /// Call after each push, unless the sender waits.
  void drop_oldest() {
    for (; is_overfull(); late_ += asked_) values_.pop_front();
  }
  std::optional<T> pop() {
    asked_ = true;
    if (values_.empty()) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    return value;
  }
  bool empty() const { return values_.empty(); }
  bool is_overfull() const { return values_.size() > capacity_; }
  int late() const { return late_; }

 private:
  size_t capacity_;
  std::deque<T> values_;
  bool asked_ = false;
  int late_ = 0;
};

}  // namespace glovebench
