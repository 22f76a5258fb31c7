#include "eval/progress.h"
#include "eval/say.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace glovebench::eval {
namespace {

constexpr int kWidth = 40;
constexpr double kDelay = 2.0;  // s

}  // namespace

Progress::Progress(std::string title, bool quiet)
    : title_(std::move(title)), enabled_(!quiet && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (last_percent_ >= 0) say("\r\x1b[K");
}

void Progress::show(double share) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const int percent = static_cast<int>(100 * share);
  if (elapsed.count() < kDelay || percent <= last_percent_) return;
  last_percent_ = percent;
  const int filled = kWidth * percent / 100;
  const double left = share > 0 ? elapsed.count() * (1 - share) / share : 0;
  say("\r\x1b[K{} [{:#<{}}{: <{}}] {:3d}%  {:.0f} s left", title_, "", filled, "", kWidth - filled, percent, left);
  std::fflush(stderr);
}

}  // namespace glovebench::eval
