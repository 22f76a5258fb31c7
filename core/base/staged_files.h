#pragma once

#include <string>

namespace glovebench {

/// Where a set's new files lie until their manifest is written (file_set.h).
inline std::string staged_folder(const std::string& folder) {
  return folder + "/.staged";
}
inline std::string staged_path(const std::string& folder, const std::string& name) {
  return staged_folder(folder) + "/" + name;
}

/// Moves the staged files of the current manifest to their places, removes what it replaced, and removes the
/// staging folder. Does nothing if there is none. For the one writer of the folder. Throws Error.
void put_in_place(const std::string& folder);

}  // namespace glovebench
