#include "eval/live_status.h"

#include <fmt/format.h>

namespace glovebench::eval {

void LiveStatus::add(double time, const TrackResult& result) {
  moments_.push_back({time, result.status == TrackStatus::tracked, result.icp_residual});
  if (moments_.size() > kFrames) moments_.pop_front();
}

std::string LiveStatus::line(int dropped) const {
  int tracked = 0;
  double residuals = 0;
  for (const Moment& moment : moments_) {
    tracked += moment.tracked;
    if (moment.tracked) residuals += moment.residual;
  }
  const double seconds = moments_.empty() ? 0 : moments_.back().time - moments_.front().time;
  const auto number = [](bool known, const char* format, double value) {
    return known ? fmt::format(fmt::runtime(format), value) : std::string("-");
  };
  return fmt::format("{} frames/s, {}% tracked, residual {} mm, {} dropped",
                     number(seconds > 0, "{:.1f}", static_cast<double>(moments_.size() - 1) / seconds),
                     number(!moments_.empty(), "{:.0f}", 100.0 * tracked / static_cast<double>(moments_.size())),
                     number(tracked > 0, "{:.1f}", 1000 * residuals / tracked), dropped);
}

}  // namespace glovebench::eval
