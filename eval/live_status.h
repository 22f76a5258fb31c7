#pragma once

#include <deque>
#include <string>

#include "core/tracker/track_result.h"

namespace glovebench::eval {

/// How tracking goes just now, in one line. The caller brings the clock.
class LiveStatus {
 public:
  static constexpr size_t kFrames = 60;  ///< of which it speaks: two seconds

  /// `time` (s, of any origin) is when the answer was there; it does not decrease.
  void add(double time, const TrackResult& result);
  /// "29.9 frames/s, 97% tracked, residual 1.3 mm, 2 dropped"; what is not known yet is a dash.
  std::string line(int dropped) const;

 private:
  struct Moment {
    double time = 0;
    bool tracked = false;
    double residual = 0;  ///< m
  };
  std::deque<Moment> moments_;
};

}  // namespace glovebench::eval
