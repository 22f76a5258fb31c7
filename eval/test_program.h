#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ci/build_paths.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/hand/posture.h"
#include "core/test_folder.h"
#include "eval/studies/study.h"
#include "eval/workbench.h"

namespace glovebench::eval {

inline std::string test_cache_folder() {
  return shared_folder(fmt::format("glovebench-test-cache-{}", getuid()));  // as ci/with-test-cache names it
}

inline WorkbenchConfig test_workbench(int threads = 2) {
  WorkbenchConfig config;
  config.cache_folder = test_cache_folder();
  config.threads = threads;
  config.quiet = true;
  return config;
}

inline StudyOptions quick_options() {
  StudyOptions options;
  options.tracker = profile("paper");
  options.quick = true;
  return options;
}

struct ProgramRun {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out;
  std::string err;
};
struct ProgramSetting {
  std::map<std::string, std::string> environment = {};
  rlim_t max_file_bytes = RLIM_INFINITY;  ///< acts like a full disk
  bool unheard = false;                   ///< output pipes have no reader
};

/// In the child: runs the program, or ends with 127.
[[noreturn]] inline void become(const std::vector<std::string>& command, const ProgramSetting& setting,
                                const std::string& out, const std::string& err) {
  for (const auto& [name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  if (int ends[2]; setting.unheard && pipe(ends) == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
  }
  const rlimit limit{setting.max_file_bytes, setting.max_file_bytes};
  if (setting.max_file_bytes != RLIM_INFINITY) setrlimit(RLIMIT_FSIZE, &limit);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

struct StartedProgram {
  pid_t process = -1;
  std::string out;
  std::string err;
};
inline StartedProgram start_program(const std::vector<std::string>& command, const ProgramSetting& setting = {}) {
  static const TestFolder folder;
  static int count = 0;
  const std::string base = folder / std::to_string(count++);
  StartedProgram started{fork(), base + ".out", base + ".err"};
  if (started.process == 0) become(command, setting, started.out, started.err);
  return started;
}
inline ProgramRun finish_program(const StartedProgram& started) {
  int status = 0;
  waitpid(started.process, &status, 0);
  const std::filesystem::path out = started.out, err = started.err;
  // A program killed at once has not opened them.
  const auto text = [](const std::filesystem::path& path) { return exists(path) ? read_file(path) : ""; };
  const ProgramRun run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return run;
}

inline ProgramRun run_program(const std::vector<std::string>& command, const ProgramSetting& setting = {}) {
  return finish_program(start_program(command, setting));
}

inline StartedProgram start_glovebench(std::vector<std::string> arguments, ProgramSetting setting = {}) {
  arguments.insert(arguments.begin(), build_paths::program("glovebench"));
  setting.environment.emplace("GLOVEBENCH_CACHE", test_cache_folder());
  return start_program(arguments, setting);
}
inline ProgramRun run_glovebench(const std::vector<std::string>& arguments, const ProgramSetting& setting = {}) {
  return finish_program(start_glovebench(arguments, setting));
}

inline std::map<std::string, std::string> read_folder(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path().string());
  }
  return files;
}

/// Without timings.json, manifest and the page's command times.
inline std::map<std::string, std::string> read_timeless(const std::string& folder) {
  std::map<std::string, std::string> files = read_folder(folder);
  EXPECT_EQ(files.erase("timings.json") + files.erase("manifest.json"), 2U);
  std::string& page = files["index.html"];
  const size_t begin = page.find("<h3>From frame to command"), end = page.find("</table>", begin);
  EXPECT_NE(end, std::string::npos);
  page.erase(begin, end - begin);
  return files;
}

inline nlohmann::json make_trajectory_json(const std::string& name, int frame_count) {
  nlohmann::json names = nlohmann::json::array(), frames = nlohmann::json::array();
  for (const AngleInfo& info : angle_infos()) names.push_back(info.name);
  for (int i = 0; i < frame_count; ++i) {
    const double bend = std::min(4 * i, 80);
    frames.push_back({{"timestamp_us", 66667 * i},
                      {"position_mm", {5 * i, 20, 700}},
                      {"quaternion_wxyz", {0.7071, -0.7071, 0, 0}},
                      {"angles_deg", {0, 0, 5, 0,  5,        3,        4, 5 + bend, 6 + bend, 4,        0,
                                      4, 6, 4, -5, 4 + bend, 6 + bend, 4, -12,      3 + bend, 7 + bend, 5}}});
  }
  return {{"format", "glovebench-trajectory"},
          {"version", 1},
          {"name", name},
          {"side", "right"},
          {"kind", "source"},
          {"joint_order", names},
          {"frames", frames}};
}

}  // namespace glovebench::eval
