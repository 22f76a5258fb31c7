#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// trajectories/formats/X_format.cpp defines `Format X_format()`; ci/corpora/format_X seeds its fuzzing. Readers
/// throw Error.
struct Format {
  std::string_view name;
  std::string_view ending;
  std::string_view description;
  // One reader is given, others are null.
  Trajectory (*trajectory)(std::string_view bytes, const std::string& where) = nullptr;
  /// `name`: if the file has none.
  PostureSet (*postures)(std::string_view bytes, const std::string& name, const std::string& where) = nullptr;
  MarkerSequence (*markers)(std::string_view bytes, Side side, const std::string& where) = nullptr;
};
/// Sorted by name.
std::span<const Format> formats();

/// Example: `formats_with(&Format::markers)`.
template <typename Reader>
std::vector<const Format*> formats_with(Reader Format::*reader) {
  std::vector<const Format*> found;
  for (const Format& format : formats())
    if (format.*reader) found.push_back(&format);
  return found;
}

/// Chooses by the path's ending. Null for an unknown one.
template <typename Reader>
const Format* format_of_file(std::string_view path, Reader Format::*reader) {
  for (const Format* format : formats_with(reader))
    if (path.ends_with(format->ending)) return format;
  return nullptr;
}

/// Built-in names lack an ending.
inline bool is_trajectory_file(std::string_view name) {
  return format_of_file(name, &Format::trajectory) != nullptr;
}
inline bool is_posture_file(std::string_view name) { return format_of_file(name, &Format::postures) != nullptr; }

/// Chooses the format by the ending.
/// Throws: Error.
Trajectory load_trajectory(const std::string& path);
/// A set without a name gets the file's.
PostureSet load_posture_set(const std::string& path);

/// Throws: Error for an unknown name.
const Format& find_marker_format(std::string_view name);
std::vector<std::string> marker_format_names();

}  // namespace glovebench::trajectories
