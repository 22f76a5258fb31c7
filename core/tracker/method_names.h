#pragma once

#include <span>
#include <string_view>

namespace glovebench {

inline constexpr std::string_view kPaperMethod = "schroeder2012";
/// "exec:COMMAND" is a program (core/adapters/process). Only the command line may name one.
inline constexpr std::string_view kProgramPrefix = "exec:";
inline bool is_program(std::string_view method) { return method.starts_with(kProgramPrefix); }
/// Sorted: X of each core/methods/X_method.cpp.
std::span<const std::string_view> method_names();

}  // namespace glovebench
