#include "trajectories/formats/format.h"

#include <fmt/ranges.h>

#include <filesystem>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/text.h"

namespace glovebench::trajectories {
namespace {

template <typename Reader>
const Format& format_to_load(const std::string& path, Reader Format::*reader) {
  if (const Format* format = format_of_file(path, reader)) return *format;
  std::set<std::string_view> endings;
  for (const Format* format : formats_with(reader)) endings.insert(format->ending);
  throw Error(path, "file name", quoted_excerpt(std::filesystem::path(path).extension().string()),
              fmt::format("the ending {}", fmt::join(endings, " or ")));
}

}  // namespace

Trajectory load_trajectory(const std::string& path) {
  return format_to_load(path, &Format::trajectory).trajectory(read_file(path, kLargestMovement), path);
}

PostureSet load_posture_set(const std::string& path) {
  const Format& format = format_to_load(path, &Format::postures);
  return format.postures(read_file(path, kLargestMovement), std::filesystem::path(path).stem().string(), path);
}

const Format& find_marker_format(std::string_view name) {
  for (const Format* format : formats_with(&Format::markers))
    if (format->name == name) return *format;
  throw Error("--format", "name", quoted_excerpt(name), one_of(marker_format_names(), name));
}

std::vector<std::string> marker_format_names() {
  std::vector<std::string> names;
  for (const Format* format : formats_with(&Format::markers)) names.emplace_back(format->name);
  return names;
}

}  // namespace glovebench::trajectories
