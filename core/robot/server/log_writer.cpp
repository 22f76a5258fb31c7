#include "core/robot/server/log_writer.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "core/robot/server/log_file.h"

namespace glovebench {
namespace {

constexpr size_t kMostBytes = 4 << 20;  // that wait: half a minute of a busy log
constexpr std::chrono::seconds kFarewell{2}, kSyncPeriod{1};

}  // namespace

struct LogWriter::Shared {
  explicit Shared(const std::string& path) : file(path) {}

  GrowingFile file;  ///< the thread's own
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::string waiting;  ///< lines, without the last line end
  uint64_t pushed = 0;  ///< lines
  bool urgent = false, ending = false, ended = false;
  Progress progress;
};

LogWriter::LogWriter(const std::string& path) : shared_(std::make_shared<Shared>(path)) {
  thread_ = std::thread([shared = shared_] { write_all(shared); });
}

LogWriter::~LogWriter() {
  finish();
}

void LogWriter::finish() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  if (shared_->changed.wait_for(lock, kFarewell, [&] { return shared_->ended; })) {
    lock.unlock();
    thread_.join();
    return;
  }
  // The disk holds the thread. It ends with the process, or when the disk lets it go.
  Progress& progress = shared_->progress;
  progress.lost += static_cast<int64_t>(shared_->pushed - progress.done);
  if (progress.failure.empty()) progress.failure = "a disk that does not answer";
  thread_.detach();
}

uint64_t LogWriter::push(const std::string& line, bool urgent) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->ending) return 0;
  if (shared_->waiting.size() + line.size() >= kMostBytes) {
    ++shared_->progress.lost;
    if (shared_->progress.failure.empty()) shared_->progress.failure = "a disk that is too slow";
    return 0;
  }
  if (!shared_->waiting.empty()) shared_->waiting += '\n';
  shared_->waiting += line;
  shared_->urgent |= urgent;
  shared_->changed.notify_all();
  return ++shared_->pushed;
}

LogWriter::Progress LogWriter::progress() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->progress;
}

void LogWriter::write_all(const std::shared_ptr<Shared>& shared) {
  auto synced = std::chrono::steady_clock::now();
  std::unique_lock lock(shared->mutex);
  for (;;) {
    shared->changed.wait(lock, [&] { return shared->ending || !shared->waiting.empty(); });
    const bool last = shared->ending;
    const std::string lines = std::exchange(shared->waiting, "");
    const uint64_t number = shared->pushed;
    bool sync = std::exchange(shared->urgent, false) || last;
    lock.unlock();
    const int64_t lost = shared->file.lost();
    const bool written = lines.empty() || shared->file.append(lines);
    const auto now = std::chrono::steady_clock::now();
    sync |= now - synced >= kSyncPeriod;
    if (sync) synced = now;
    const bool fine = (!sync || shared->file.sync()) && written;
    lock.lock();
    shared->progress.done = number;
    if (!fine) shared->progress.failed = number;
    if (fine && sync) shared->progress.durable = number;
    shared->progress.lost += shared->file.lost() - lost;
    if (shared->progress.failure.empty()) shared->progress.failure = shared->file.failure();
    if (!last) continue;
    shared->ended = true;
    shared->changed.notify_all();
    return;
  }
}

}  // namespace glovebench
