#include "core/adapters/dds/server/stated_interval.h"

#include <algorithm>

#include "core/base/math.h"

namespace glovebench {
namespace {

constexpr double kAhead = 0.5;             // s: what is stated
constexpr double kLeft = 0.25;             // s: then it is stated anew
constexpr int64_t kRestateUs = 1'000'000;  // so that the end of a log has one
constexpr int64_t kRetryUs = 100'000;      // after a disk that failed
constexpr double kStatedAngleTolerance = radians_from_degrees(1e-5);

bool contains(const JointInterval& outer, const JointInterval& inner) {
  for (size_t j = 0; j < outer.min.size(); ++j)
    if (!(inner.min[j] >= outer.min[j] && inner.max[j] <= outer.max[j])) return false;
  return true;
}

}  // namespace

bool is_one_step(const JointInterval& interval, const std::vector<JointMotion>& joints, double seconds) {
  for (size_t j = 0; j < joints.size(); ++j)
    if (!(interval.max.at(j) - interval.min.at(j) <= joints[j].speed * seconds + kStatedAngleTolerance))
      return false;
  return true;
}

JointInterval StatedInterval::reach(const std::vector<double>& positions, double seconds) const {
  JointInterval reached;
  for (size_t j = 0; j < joints_.size(); ++j) {
    const double way = joints_[j].speed * seconds, position = positions.at(j);
    reached.min.push_back(std::min(position, std::max(joints_[j].min, position - way)));
    reached.max.push_back(std::max(position, std::min(joints_[j].max, position + way)));
  }
  return reached;
}

bool StatedInterval::covers(const JointInterval& reached) const {
  return durable_ && contains(*durable_, reached) && (!doubtful_ || contains(*doubtful_, reached)) &&
         (!pending_ || contains(pending_->interval, reached));
}

bool StatedInterval::allows(const std::vector<double>& positions, double seconds) const {
  return covers(reach(positions, seconds));
}

std::optional<JointInterval> StatedInterval::next(const std::vector<double>& positions, bool at_rest,
                                                  int64_t now_us) {
  if (pending_) return std::nullopt;
  const int64_t age_us = stated_us_ ? now_us - *stated_us_ : kRestateUs;
  if (doubtful_ && age_us < kRetryUs) return std::nullopt;
  const JointInterval place = reach(positions, 0);
  const bool fits = at_rest ? durable_ == place && !doubtful_ : allows(positions, kLeft);
  if (fits && age_us < kRestateUs) return std::nullopt;
  return at_rest ? place : reach(positions, kAhead);
}

void StatedInterval::stated(JointInterval interval, uint64_t line, int64_t now_us) {
  stated_us_ = now_us;
  if (line > 0) pending_ = Pending{std::move(interval), line};
}

void StatedInterval::update(uint64_t done, uint64_t durable, uint64_t failed) {
  if (!pending_ || pending_->line > done) return;
  if (pending_->line <= durable && pending_->line > failed) {
    durable_ = std::move(pending_->interval);
    doubtful_.reset();
  } else if (!doubtful_) {
    doubtful_ = std::move(pending_->interval);
  } else {
    for (size_t j = 0; j < joints_.size(); ++j) {
      doubtful_->min[j] = std::max(doubtful_->min[j], pending_->interval.min[j]);
      doubtful_->max[j] = std::min(doubtful_->max[j], pending_->interval.max[j]);
    }
  }
  pending_.reset();
}

}  // namespace glovebench
