// glovebench_fuzz --list: prints the names of all fuzz targets.
// glovebench_fuzz NAME FILE|FOLDER...: feeds files to a target. Exit code 1: a file broke it; 2: no such target or
// file. With GLOVEBENCH_FUZZ this is a libFuzzer program for the target in the environment variable
// GLOVEBENCH_FUZZ_TARGET.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/fuzz_target.h"
#include "core/base/input_file.h"
#include "trajectories/formats/format.h"
#include "trajectories/posture_file.h"

namespace glovebench {

std::vector<FuzzTarget> fuzz_targets_of_files();

namespace {

namespace fs = std::filesystem;

void check_trajectory(const trajectories::Trajectory& trajectory) {
  const std::string text = canonical_text(trajectory);
  without_error([&] {
    check(canonical_text(trajectories::parse_trajectory(text, "again")) == text, "a trajectory returns");
  });
}

void check_postures(const PostureSet& set) {
  const std::string text = trajectories::canonical_text(set);
  without_error([&] {
    check(trajectories::canonical_text(trajectories::parse_postures_json(text, "again")) == text, "a set returns");
  });
}

void check_markers(const trajectories::MarkerSequence& sequence) {
  int64_t before_us = -1;
  for (const trajectories::MarkerFrame& frame : sequence.frames) {
    check(frame.timestamp_us > before_us, "times increase");
    before_us = frame.timestamp_us;
    check(frame.points.size() == sequence.names.size(), "a point for each name");
    for (const Eigen::Vector3d& p : frame.points) {
      const bool in_reach = p.cwiseAbs().maxCoeff() <= trajectories::kMaxCoordinate * (1 + 1e-12);
      check(trajectories::is_seen(p) ? in_reach : p.array().isNaN().all(), "a point in reach or a gap");
    }
  }
}

/// For a format that we also write.
void check_csv_returns(const trajectories::Format& csv, std::string_view bytes) {
  const auto text_of = [&](std::string_view text) {
    return trajectories::csv_markers(csv.markers(text, Side::right, "capture.csv"));
  };
  const std::string text = text_of(bytes);
  without_error([&] { check(text_of(text) == text, "a capture returns"); });
}

/// Checks that what is read and written reads back equal; points lie in reach or are gaps, one per name; times
/// increase.
void fuzz_format(const trajectories::Format& format, std::string_view bytes) {
  const std::string where = "file" + std::string(format.ending);
  if (format.trajectory) check_trajectory(format.trajectory(bytes, where));
  if (format.postures) check_postures(format.postures(bytes, "set", where));
  if (!format.markers) return;
  if (format.name == "csv") check_csv_returns(format, bytes);
  for (const Side side : {Side::right, Side::left})
    expect_value_or_error([&] { check_markers(format.markers(bytes, side, where)); });
}

/// One per file X_fuzz.cpp and per file format.
std::vector<FuzzTarget> fuzz_targets() {
  std::vector<FuzzTarget> targets = fuzz_targets_of_files();
  for (const trajectories::Format& format : trajectories::formats())
    targets.push_back(
        {"format_" + std::string(format.name), [&format](std::string_view bytes) { fuzz_format(format, bytes); }});
  return targets;
}

FuzzTarget find_target(std::string_view name) {
  const std::vector<FuzzTarget> targets = fuzz_targets();
  const auto found = std::ranges::find(targets, name, &FuzzTarget::name);
  if (found == targets.end())
    throw Error("fuzz target", "name", std::string(name), "one that glovebench_fuzz --list prints");
  return *found;
}

#ifndef GLOVEBENCH_FUZZ

int print_list() {
  for (const FuzzTarget& target : fuzz_targets()) std::printf("%s\n", target.name.c_str());
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
int replay(const FuzzTarget& target, std::span<char*> arguments) {
  std::string current = "the list of files";
  try {
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
  static const glovebench::FuzzTarget target = [] {
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
  try {
    if (argc > 2) return glovebench::replay(glovebench::find_target(argv[1]), arguments.subspan(2));
  } catch (const glovebench::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  std::fprintf(stderr, "usage: glovebench_fuzz --list | NAME FILE|FOLDER...\n");
  return 2;
}
#endif
