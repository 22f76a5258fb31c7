#include "core/methods/method.h"

#include <fmt/ranges.h>

#include <vector>

#include "core/base/error.h"

namespace glovebench {

std::span<const std::string_view> method_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const MethodEntry& entry : methods()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

const MethodEntry& find_method(std::string_view name) {
  for (const MethodEntry& entry : methods())
    if (entry.name == name) return entry;
  throw Error("method", "name", std::string(name), fmt::format("one of {}", fmt::join(method_names(), ", ")));
}

}  // namespace glovebench
