// glovebench_fuzz --list: the names of all fuzz targets.
// glovebench_fuzz NAME FILE|FOLDER...: feeds files to a target. Exit code 1: one broke it; 2: there is none.
// With GLOVEBENCH_FUZZ this is a libFuzzer program for the target that the environment variable
// GLOVEBENCH_FUZZ_TARGET names.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/file.h"
#include "core/base/fuzz_target.h"

namespace glovebench {

std::span<const FuzzTarget> fuzz_targets();

namespace {

namespace fs = std::filesystem;

const FuzzTarget& find_target(std::string_view name) {
  const auto found = std::ranges::find(fuzz_targets(), name, &FuzzTarget::name);
  if (found == fuzz_targets().end())
    throw Error("fuzz target", "name", std::string(name), "one that glovebench_fuzz --list prints");
  return *found;
}

#ifndef GLOVEBENCH_FUZZ

int print_list() {
  for (const FuzzTarget& target : fuzz_targets()) std::printf("%s\n", target.name.data());
  return 0;
}

std::vector<fs::path> files_of(std::span<char*> arguments) {
  std::vector<fs::path> files;
  for (const char* argument : arguments) {
    if (!fs::is_directory(argument)) {
      files.emplace_back(argument);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(argument)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Returns the exit code.
int replay(std::string_view name, std::span<char*> arguments) {
  std::string current = "the list of files";
  try {
    const FuzzTarget& target = find_target(name);
    const std::vector<fs::path> files = files_of(arguments);
    for (const fs::path& file : files) {
      current = file.string();
      const std::string content = read_file(current);
      expect_value_or_error([&] { target.run(content); });
    }
    std::printf("%zu inputs\n", files.size());
    return files.empty() ? 2 : 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", current.c_str(), e.what());
    return 1;
  }
}

#endif

}  // namespace
}  // namespace glovebench

#ifdef GLOVEBENCH_FUZZ
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const glovebench::FuzzTarget& target = [&]() -> const glovebench::FuzzTarget& {
    const char* name = std::getenv("GLOVEBENCH_FUZZ_TARGET");
    return glovebench::find_target(name != nullptr ? name : "");
  }();
  glovebench::expect_value_or_error([&] { target.run({reinterpret_cast<const char*>(data), size}); });
  return 0;
}
#else
int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<size_t>(argc));
  if (argc == 2 && std::string_view(argv[1]) == "--list") return glovebench::print_list();
  if (argc > 2) return glovebench::replay(argv[1], arguments.subspan(2));
  std::fprintf(stderr, "usage: glovebench_fuzz --list | NAME FILE|FOLDER...\n");
  return 2;
}
#endif
