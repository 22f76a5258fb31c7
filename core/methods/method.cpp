#include "core/methods/method.h"

#include <vector>

#include "core/base/registry.h"

namespace glovebench {

std::span<const std::string_view> method_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const MethodEntry& entry : methods()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

const MethodEntry& find_method(std::string_view name) { return find_in(methods(), name, "method", "name"); }

}  // namespace glovebench
