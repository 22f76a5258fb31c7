#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench {

/// Checks that X_KIND.cpp's entry has the name X, if any.
template <typename Entry>
Entry named(std::string_view name, Entry entry) {
  if constexpr (requires { entry.name; }) check(entry.name == name, "an entry has the name of its file");
  return entry;
}

/// Sorted, of a registry (glovebench_registry in CMakeLists.txt).
template <typename Entry>
std::vector<std::string> names_in(std::span<const Entry> entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

/// Throws: Error for an unknown name.
template <typename Entry>
const Entry& find_in(std::span<const Entry> entries, std::string_view name, const char* where, const char* field) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  if (found == entries.end()) throw Error(where, field, std::string(name), one_of(names_in(entries), name));
  return *found;
}

}  // namespace glovebench
