#include "eval/share.h"

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestScript = uint64_t{16} << 20;  // bytes

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string share_folder() {
  const std::string chosen = environment("GLOVEBENCH_SHARE");
  std::error_code error;
  const fs::path folder = chosen.empty() ? fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() /
                                               "share" / "glovebench"
                                         : fs::path(chosen);
  if (!fs::is_directory(folder, error)) {
    throw Error(folder.string(), "data folder", "nothing",
                "the program's data beside it (or GLOVEBENCH_SHARE set to it)");
  }
  return folder.string();
}

std::string hand_mesh_path() {
  return share_folder() + "/generic-hand-right.glb";
}

std::string trajectory_folder() {
  return share_folder() + "/trajectories/data";
}

std::string suite_folder() {
  return share_folder() + "/suites";
}

std::vector<std::string> page_scripts() {
  const std::string folder = share_folder() + "/page/";
  std::vector<std::string> scripts;
  for (const std::string name : {"vega", "vega-lite", "vega-embed"}) {
    scripts.push_back("/*! " + name + "\n" + read_file(folder + name + ".license.txt", kLargestScript) + "*/\n" +
                      read_file(folder + name + ".min.js", kLargestScript));
  }
  return scripts;
}

std::string default_cache_folder() {
  if (const std::string chosen = environment("GLOVEBENCH_CACHE"); !chosen.empty()) return chosen;
  if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty()) return cache + "/glovebench";
  if (const std::string home = environment("HOME"); !home.empty()) return home + "/.cache/glovebench";
  return "glovebench-cache";
}

}  // namespace glovebench::eval
