#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr int kBarWidth = 40;
constexpr double kBarDelay = 2.0;        // s
constexpr double kStatusInterval = 0.5;  // s

bool is_shown(bool quiet) {
  return !quiet && isatty(STDERR_FILENO) != 0;
}

}  // namespace

Progress::Progress(std::string title, bool quiet) : title_(std::move(title)), enabled_(is_shown(quiet)) {}

Progress::~Progress() {
  if (last_percent_ >= 0) say("\r\x1b[K");
}

void Progress::show(double share) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const int percent = static_cast<int>(100 * share);
  if (elapsed.count() < kBarDelay || percent <= last_percent_) return;
  last_percent_ = percent;
  const int filled = kBarWidth * percent / 100;
  const double left = share > 0 ? elapsed.count() * (1 - share) / share : 0;
  say("\r\x1b[K{} [{:#<{}}{: <{}}] {:3d}%  {:.0f} s left", title_, "", filled, "", kBarWidth - filled, percent,
      left);
  std::fflush(stderr);
}

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

StatusLine::StatusLine(bool quiet) : enabled_(is_shown(quiet)) {}

StatusLine::~StatusLine() {
  if (last_ > 0) say("\n");
}

void StatusLine::show(const TrackResult& result, int dropped) {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  status_.add(elapsed.count(), result);
  if (!enabled_ || elapsed.count() < last_ + kStatusInterval) return;
  last_ = elapsed.count();
  say("\r\x1b[K{}", status_.line(dropped));
  std::fflush(stderr);
}

}  // namespace glovebench::eval
