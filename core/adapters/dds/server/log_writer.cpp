#include "core/adapters/dds/server/log_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <utility>

#include "core/base/error.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

constexpr size_t kMostBytes = 4 << 20;  // waiting; half a minute of a busy log
constexpr std::chrono::seconds kSyncPeriod{1};

/// Locks a file, for as long as it is open.
void lock_file(int descriptor, const std::string& path) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK)
    throw Error(path, "log", "another server that is writing it", "a log of its own for each server");
  throw Error(path, "log", std::strerror(errno), "a file that can be locked");
}

bool ends_within_a_line(int descriptor) {
  char last = '\n';
  const off_t size = lseek(descriptor, 0, SEEK_END);
  return size > 0 && pread(descriptor, &last, 1, size - 1) == 1 && last != '\n';
}

}  // namespace

int64_t changed_us(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw Error(path, "log", std::strerror(errno), "a file");
  return int64_t{status.st_mtim.tv_sec} * 1'000'000 + status.st_mtim.tv_nsec / 1000;
}

std::string read_tail(const std::string& path, uint64_t max_bytes) {
  if (!std::filesystem::is_regular_file(path)) return "";
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<int64_t>(file.tellg());
  const int64_t length = std::min(size, static_cast<int64_t>(max_bytes));
  std::string text(static_cast<size_t>(std::max<int64_t>(length, 0)), '\0');
  file.seekg(size - length);
  file.read(text.data(), length);
  if (!file) throw Error(path, "file", "nothing that can be read", "a file");
  return text;
}

struct LogWriter::Shared {
  explicit Shared(const std::string& its_path);
  ~Shared() { ::close(descriptor); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  /// Writes one line or more, given without the last line end. Returns how many were lost, and why.
  std::pair<int64_t, int> append(const std::string& lines);
  /// Why the file's name does not lead to all that was written; empty if it does.
  std::string misplaced() const;

  // The thread's own.
  const std::string path;
  int descriptor;
  bool is_regular = false;
  off_t size = 0;       ///< with all that was written
  bool is_cut = false;  ///< the file does not end with a whole line

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::string waiting;  ///< lines, without the last line end
  uint64_t pushed = 0;  ///< lines
  bool urgent = false, ending = false, ended = false;
  Progress progress;
};

LogWriter::Shared::Shared(const std::string& its_path)
    : path(its_path), descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor < 0) throw Error(path, "file", std::strerror(errno), "one that can be appended to");
  struct stat status {};
  is_regular = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (!is_regular) return;
  try {
    lock_file(descriptor, path);
    sync_folder(folder_above(find_output(path).path));
  } catch (const Error&) {
    ::close(descriptor);
    throw;
  }
  size = status.st_size;
  is_cut = ends_within_a_line(descriptor);
}

std::string LogWriter::Shared::misplaced() const {
  struct stat held {};
  struct stat named {};
  if (!is_regular) return "";
  if (fstat(descriptor, &held) != 0) return std::strerror(errno);
  if (stat(path.c_str(), &named) != 0 || named.st_dev != held.st_dev || named.st_ino != held.st_ino)
    return "a file that was removed or renamed";
  return held.st_size < size ? "a file that was cut" : "";
}

std::pair<int64_t, int> LogWriter::Shared::append(const std::string& lines) {
  const std::string whole = (is_cut ? "\n" : "") + lines + "\n";
  const Written written = write_all(descriptor, whole);
  if (written.bytes > 0) is_cut = whole[written.bytes - 1] != '\n';
  size += static_cast<off_t>(written.bytes);
  if (written.error == 0) return {0, 0};
  futimens(descriptor, nullptr);  // needs no room, and tells the next reader that lines are missing
  int64_t lost = std::ranges::count(whole.substr(written.bytes), '\n');
  if (written.bytes == 0 && whole.front() == '\n') --lost;  // this line end belongs to an earlier lost line
  return {lost, written.error};
}

LogWriter::LogWriter(const std::string& path) : shared_(std::make_shared<Shared>(path)) {
  thread_ = std::thread([shared = shared_] { write_lines(shared); });
}

LogWriter::~LogWriter() { finish(); }

void LogWriter::finish(std::chrono::seconds longest) {
  if (!thread_.joinable()) return;
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  if (shared_->changed.wait_for(lock, longest, [&] { return shared_->ended; })) {
    lock.unlock();
    thread_.join();
    return;
  }
  // The disk blocks the thread, which ends with the process or when the disk answers.
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

void LogWriter::write_lines(const std::shared_ptr<Shared>& shared) {
  auto synced = std::chrono::steady_clock::now();
  std::unique_lock lock(shared->mutex);
  for (;;) {
    shared->changed.wait(lock, [&] { return shared->ending || !shared->waiting.empty(); });
    const bool last = shared->ending;
    const std::string lines = std::exchange(shared->waiting, "");
    const uint64_t number = shared->pushed;
    bool sync = std::exchange(shared->urgent, false) || last;
    lock.unlock();
    auto [lost, error] = lines.empty() ? std::pair<int64_t, int>() : shared->append(lines);
    const auto now = std::chrono::steady_clock::now();
    sync |= now - synced >= kSyncPeriod;
    if (sync) synced = now;
    if (const int failed = sync ? sync_file(shared->descriptor) : 0; error == 0) error = failed;
    const std::string misplaced = shared->misplaced();
    const std::string failure = !misplaced.empty() ? misplaced : error != 0 ? std::strerror(error) : "";
    if (!misplaced.empty()) lost = lines.empty() ? 0 : std::ranges::count(lines, '\n') + 1;
    lock.lock();
    Progress& progress = shared->progress;
    progress.done = number;
    progress.lost += lost;
    progress.misplaced = !misplaced.empty();
    if (!failure.empty()) progress.failed = number;
    if (failure.empty() && sync && shared->is_regular) progress.durable = number;
    if (progress.failure.empty()) progress.failure = failure;
    if (!last) continue;
    shared->ended = true;
    shared->changed.notify_all();
    return;
  }
}

}  // namespace glovebench
