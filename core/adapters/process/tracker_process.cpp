#include "core/adapters/process/tracker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <system_error>

namespace glovebench {
namespace {

constexpr int kKilled = 128 + SIGKILL;

struct Pipe {
  Descriptor read, write;
};

[[noreturn]] void refuse(const char* what) {
  throw Error("the program cannot be started", what, std::generic_category().message(errno), "success");
}

Pipe make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) refuse("pipe");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// From here to the next comment: in a child of a program with threads, so only calls that are safe in a signal
// handler.

[[noreturn]] void become_program(const char* command, int in, int out) {
  setpgid(0, 0);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);
  for (int number = 1; number < NSIG; ++number) std::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execl("/bin/sh", "sh", "-c", command, nullptr);
  _exit(127);
}

/// Kills the children that the kernel lists, among them orphans that this process adopted.
void kill_children() {
  char list[4096];
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  const ssize_t size = read(file, list, sizeof list);
  close(file);
  for (const char *at = list, *end = list + std::max<ssize_t>(size, 0); at < end;) {
    pid_t child = 0;
    const auto number = std::from_chars(at, end, child);
    if (number.ec == std::errc() && number.ptr < end) ::kill(child, SIGKILL);  // a cut number comes again
    at = number.ptr + 1;
  }
}

/// Kills the program and all that it started. Returns the program's exit code.
int end_descendants(pid_t program) {
  constexpr int kMostRounds = 5000;  // of 1 ms
  int code = kKilled;
  bool has_ended = false;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!has_ended) ::kill(-program, SIGKILL);
    kill_children();
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended != program) continue;
      has_ended = true;
      code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    if (ended < 0) break;  // no child is left
    usleep(1000);
  }
  return code;
}

/// Starts the program, adopts its orphans, and kills them all when the other end of `lifeline` closes.
[[noreturn]] void guard(const char* command, int in, int out, int lifeline) {
  setpgid(0, 0);  // Ctrl-C is for glovebench
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) std::signal(number, SIG_IGN);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t program = fork();
  if (program == 0) become_program(command, in, out);
  if (program < 0) _exit(125);
  setpgid(program, program);
  dup2(lifeline, STDIN_FILENO);
  close(STDOUT_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);
  char byte;
  while (read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
  }
  _exit(end_descendants(program));
}

// In glovebench itself again.

std::string ending(int code) {
  if (code == kKilled) return "the program was killed, or closed its input or output";
  if (code > 128) return fmt::format("the program was ended by signal {} ({})", code - 128, strsignal(code - 128));
  return fmt::format("the program ended with exit code {}", code);
}

/// ms until `deadline`, for poll.
int left_until(TrackerProcess::Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - TrackerProcess::Clock::now()).count();
  return static_cast<int>(std::clamp<int64_t>(left, 0, 1 << 30));
}

}  // namespace

ProgramEnded::ProgramEnded(int code) : Error(ending(code)), exit_code(code) {}

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

TrackerProcess::TrackerProcess(const std::string& command) {
  Pipe frames = make_pipe(), answers = make_pipe(), life = make_pipe();
  constexpr int kPipeBytes = 1 << 20;  // the kernel's limit for users; less costs time only
  fcntl(frames.write.number(), F_SETPIPE_SZ, kPipeBytes);
  for (const Descriptor* own : {&frames.write, &answers.read})
    if (fcntl(own->number(), F_SETFL, O_NONBLOCK) != 0) refuse("pipe");
  guard_ = fork();
  if (guard_ < 0) refuse("process");
  if (guard_ == 0) guard(command.c_str(), frames.read.number(), answers.write.number(), life.read.number());
  to_program_ = std::move(frames.write);
  from_program_ = std::move(answers.read);
  lifeline_ = std::move(life.write);
}

TrackerProcess::~TrackerProcess() {
  constexpr std::chrono::seconds kLastWork(1);
  if (guard_ < 0) return;
  to_program_.close();
  const Clock::time_point deadline = Clock::now() + kLastWork;
  pollfd answers = {from_program_.number(), POLLIN, 0};
  char ignored[4096];
  while (Clock::now() < deadline) {
    if (poll(&answers, 1, left_until(deadline)) <= 0) continue;
    if (read(from_program_.number(), ignored, sizeof ignored) == 0) break;
  }
  kill();
}

int TrackerProcess::kill() {
  if (guard_ < 0) return exit_code_;
  to_program_.close();
  from_program_.close();
  lifeline_.close();
  int status = 0;
  while (waitpid(guard_, &status, 0) < 0 && errno == EINTR) {
  }
  guard_ = -1;
  return exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : kKilled;
}

std::string TrackerProcess::exchange(std::span<const std::string_view> parts, Clock::time_point deadline) {
  size_t part = 0;
  std::string_view left = parts.front();
  while (true) {
    while (left.empty() && part < parts.size())
      if (++part < parts.size()) left = parts[part];
    const bool is_sent = part == parts.size();
    const size_t end = received_.find('\n');
    if (is_sent && end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    if (end == std::string::npos && received_.size() > kLongestAnswer)
      throw Error(fmt::format("a line of more than {} bytes", kLongestAnswer));
    if (Clock::now() >= deadline)
      throw Error(is_sent ? "no answer in time" : "the program did not read the frame in time");
    // A negative descriptor is not waited for.
    pollfd ends[] = {{is_sent ? -1 : to_program_.number(), POLLOUT, 0},
                     {end == std::string::npos ? from_program_.number() : -1, POLLIN, 0}};
    if (poll(ends, std::size(ends), left_until(deadline)) <= 0) continue;
    if (ends[1].revents != 0) receive();
    if (ends[0].revents != 0) send(left);
  }
}

void TrackerProcess::send(std::string_view& bytes) {
  const ssize_t count = write(to_program_.number(), bytes.data(), bytes.size());
  if (count >= 0) return bytes.remove_prefix(static_cast<size_t>(count));
  if (errno != EAGAIN && errno != EINTR) throw ProgramEnded(kill());
}

void TrackerProcess::receive() {
  char bytes[4096];
  const ssize_t count = read(from_program_.number(), bytes, sizeof bytes);
  if (count > 0) received_.append(bytes, static_cast<size_t>(count));
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) throw ProgramEnded(kill());
}

}  // namespace glovebench
