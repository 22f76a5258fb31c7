#include "core/adapters/dds/openssl.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

void check_system(int error) {
  if (error != 0) throw Error("openssl", "program", std::strerror(error), "one that runs (Debian: openssl)");
}

/// A file without a name, which other programs see only as one of their standard streams.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = "") : descriptor_(memfd_create("openssl", MFD_CLOEXEC)) {
    check_system(descriptor_ < 0 ? errno : 0);
    check_system(write_all(descriptor_, content).error);
    lseek(descriptor_, 0, SEEK_SET);
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string content() const {
    std::string text(static_cast<size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    return pread(descriptor_, text.data(), text.size(), 0) == std::ssize(text) ? text : "";
  }

 private:
  int descriptor_;
};

std::string last_line(std::string text) {
  text.erase(text.find_last_not_of("\n \t") + 1);
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

OpensslResult run_openssl(const std::string& folder, std::vector<std::string> arguments, std::string_view input) {
  arguments.insert(arguments.begin(), "openssl");
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);

  const MemoryFile in(input), out, err;
  posix_spawn_file_actions_t actions;
  check_system(posix_spawn_file_actions_init(&actions));
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  const int error = posix_spawnp(&process, "openssl", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  check_system(error);

  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) check_system(errno);
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, out.content(), last_line(err.content())};
}

}  // namespace glovebench
