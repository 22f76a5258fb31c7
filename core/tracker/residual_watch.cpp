#include "core/tracker/residual_watch.h"

namespace glovebench {
namespace {

constexpr double kAlarming = 0.0012;  ///< m
constexpr int kLeastFrames = 30;

}  // namespace

void ResidualWatch::add(const TrackResult& result) {
  if (result.status != TrackStatus::tracked || !result.certainty) return;
  ++frames_;
  sum_ += result.icp_residual;
}

std::optional<double> ResidualWatch::alarming_residual() const {
  if (frames_ < kLeastFrames || sum_ / frames_ < kAlarming) return {};
  return sum_ / frames_;
}

}  // namespace glovebench
