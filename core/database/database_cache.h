#pragma once

#include <functional>
#include <string>

#include "core/database/database.h"

namespace glovebench {

/// Of the name of a database file.
inline constexpr std::string_view kDatabaseEnding = ".glovedb";

/// Loads the database of these inputs from `folder`, or builds and stores it there. The file's name holds the hash
/// of all inputs and that of the code that builds: a change of either makes another file, as does low memory. Two
/// processes that want the same one wait for each other; a damaged file is named through `message` and rebuilt. A
/// build removes what other code built of the same inputs.
struct DatabaseCache {
  std::string folder;
  ViewRendererFactory renderers;
  std::string source_hash;  ///< of the code that builds, `renderers` included (render::database_source_hash)
  int threads = 1;
  DatabaseMemory memory = DatabaseMemory::normal;
  std::function<void(const std::string&)> message = [](const std::string&) {};
  std::function<void(double)> progress;  ///< share built, 0..1; may be empty

  Database get(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
               std::span<const int> sizes) const;
  /// Where `get` keeps the database of these inputs.
  std::string path(const PostureSet& postures, const HandModel& model, const ViewConfig& views) const;
};

}  // namespace glovebench
