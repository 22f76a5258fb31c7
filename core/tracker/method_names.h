#pragma once

#include <span>
#include <string_view>

namespace glovebench {

inline constexpr std::string_view kPaperMethod = "schroeder2012";
/// Sorted: the X of each core/methods/X_method.cpp.
std::span<const std::string_view> method_names();

}  // namespace glovebench
