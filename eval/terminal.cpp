#include "eval/terminal.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <optional>

namespace glovebench::eval {
namespace {

constexpr int kBarWidth = 40;
constexpr double kBarDelay = 2.0;        // s
constexpr double kStatusInterval = 0.5;  // s

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

double seconds_left(double share, double elapsed) { return share > 0 ? elapsed * (1 - share) / share : 0; }

/// When and how often progress goes to a log.
struct ProgressLog {
  std::mutex mutex;
  std::optional<double> interval;  ///< s; empty: never
  std::chrono::steady_clock::time_point last;

  bool is_due() {
    const std::lock_guard lock(mutex);
    const auto now = std::chrono::steady_clock::now();
    if (!interval || std::chrono::duration<double>(now - last).count() < *interval) return false;
    last = now;
    return true;
  }
};

ProgressLog& progress_log() {
  static ProgressLog log;
  return log;
}

volatile std::sig_atomic_t wish = 0;

void note_wish(int) {
  wish = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// Stays installed, since the kernel and the shell may both report a closed terminal.
void note_hang_up(int) { wish = 1; }

}  // namespace

size_t terminal_columns() {
  constexpr size_t kUsual = 80, kFewest = 60;
  winsize size = {};
  const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? std::max<size_t>(size.ws_col, kFewest) : kUsual;
}

void log_progress(double interval) {
  ProgressLog& log = progress_log();
  const std::lock_guard lock(log.mutex);
  log.interval = interval;
  log.last = std::chrono::steady_clock::now();
}

Progress::Progress(std::string title, bool quiet)
    : title_(std::move(title)), quiet_(quiet), has_bar_(is_terminal()) {}

Progress::~Progress() { erase_bar(); }

void Progress::show(double share) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (has_bar_) return show_bar(share, elapsed.count());
  if (progress_log().is_due())
    say("{}: {:.0f}%, {:.0f} s left\n", title_, 100 * share, seconds_left(share, elapsed.count()));
}

void Progress::erase_bar() {
  if (last_percent_ >= 0) say("\r\x1b[K");
  last_percent_ = -1;
}

void Progress::show_bar(double share, double elapsed) {
  const int percent = static_cast<int>(100 * share);
  if (percent >= 100) return erase_bar();
  if (elapsed < kBarDelay || percent <= last_percent_) return;
  last_percent_ = percent;
  const int filled = kBarWidth * percent / 100;
  say("\r\x1b[K{} [{:#<{}}{: <{}}] {:3d}%  {:.0f} s left", title_, "", filled, "", kBarWidth - filled, percent,
      seconds_left(share, elapsed));
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

StatusLine::StatusLine(bool quiet) : enabled_(!quiet && is_terminal()) {}

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

Interruption::Interruption() {
  wish = 0;
  struct sigaction once = {};
  once.sa_handler = note_wish;
  once.sa_flags = SA_RESTART;
  sigaction(SIGINT, &once, &before_int_);
  sigaction(SIGTERM, &once, &before_term_);
  sigaction(SIGHUP, nullptr, &before_hup_);
  if (before_hup_.sa_handler == SIG_IGN) return;  // nohup: goes on without a terminal
  struct sigaction always = once;
  always.sa_handler = note_hang_up;
  sigaction(SIGHUP, &always, nullptr);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
  sigaction(SIGHUP, &before_hup_, nullptr);
}

bool Interruption::wished() { return wish != 0; }

}  // namespace glovebench::eval
