#include "core/methods/method.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace glovebench {

const MethodEntry& find_method(std::string_view name) {
  for (const MethodEntry& entry : methods())
    if (entry.name == name) return entry;
  throw Error("method", "name", std::string(name), fmt::format("one of {}", fmt::join(method_names(), ", ")));
}

}  // namespace glovebench
