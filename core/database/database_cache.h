#pragma once

#include <functional>
#include <string>

#include "core/database/database.h"

namespace glovebench {

inline constexpr std::string_view kDatabaseEnding = ".glovedb";

/// Loads a database from `folder`, or builds and stores it. Waits for another process's build. Reports and
/// rebuilds a damaged file. Building removes files of older code.
struct DatabaseCache {
  std::string folder;
  ViewRendererFactory renderers;
  std::string source_hash;
  int threads = 1;
  DatabaseMemory memory = DatabaseMemory::normal;
  std::function<void(const std::string&)> message = [](const std::string&) {};
  std::function<void(double)> progress;  ///< share built, 0..1

  Database get(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
               std::span<const int> sizes) const;
  std::string path(const PostureSet& postures, const HandModel& model, const ViewConfig& views) const;
};

}  // namespace glovebench
