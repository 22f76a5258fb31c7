#pragma once

#include <span>
#include <string_view>

namespace glovebench {

/// The method of the paper, and the default.
inline constexpr std::string_view kPaperMethod = "schroeder2012";
/// The names of all methods, sorted: the X of the files X_method.cpp in this folder.
std::span<const std::string_view> method_names();

}  // namespace glovebench
