#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// A file format. One file defines it: trajectories/formats/X_format.cpp has `Format X_format()`, and
/// ci/corpora/format_X holds files for the fuzz driver to start from. Readers throw Error naming `where`, the
/// field, what was found and what was expected.
struct Format {
  std::string_view name;         ///< X
  std::string_view ending;       ///< ".json"
  std::string_view description;  ///< one line
  // Exactly one reader is given: what a file holds.
  Trajectory (*trajectory)(std::string_view bytes, const std::string& where) = nullptr;
  /// `name` is the set's where the format holds none.
  PostureSet (*postures)(std::string_view bytes, const std::string& name, const std::string& where) = nullptr;
  MarkerSequence (*markers)(std::string_view bytes, Side side, const std::string& where) = nullptr;
};
/// Sorted by name.
std::span<const Format> formats();

/// The formats that have this reader: `formats_with(&Format::markers)`.
template <typename Reader>
std::vector<const Format*> formats_with(Reader Format::*reader) {
  std::vector<const Format*> found;
  for (const Format& format : formats())
    if (format.*reader) found.push_back(&format);
  return found;
}

/// The format with this reader and the ending of the path; null if there is none.
template <typename Reader>
const Format* format_of_file(std::string_view path, Reader Format::*reader) {
  for (const Format* format : formats_with(reader))
    if (path.ends_with(format->ending)) return format;
  return nullptr;
}

/// Whether a name is that of a file, by its ending; the names of our own trajectories and posture sets have none.
inline bool is_trajectory_file(std::string_view name) {
  return format_of_file(name, &Format::trajectory) != nullptr;
}
inline bool is_posture_file(std::string_view name) {
  return format_of_file(name, &Format::postures) != nullptr;
}

/// Reads a file in the format of its ending. Throws Error.
Trajectory load_trajectory(const std::string& path);
/// A set of a format without names has that of its file.
PostureSet load_posture_set(const std::string& path);

/// The format of markers with that name. Throws Error listing the known ones.
const Format& find_marker_format(std::string_view name);
/// Separated by commas, for messages and help.
std::string marker_format_names();

}  // namespace glovebench::trajectories
