#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/robot/robot_command.h"

namespace glovebench {

/// No line of ours is a third as long.
inline constexpr size_t kLongestCommandLine = 16'384;  // bytes
/// An hour of commands at 30 Hz.
inline constexpr uint64_t kLargestCommandFile = uint64_t{256} << 20;  // bytes

/// One command from its line of JSON (core/robot/README.md), with or without the line end. Strict: every key once
/// and no others, no number over 1e9, names known, a unit quaternion, what contradicts itself refused. Throws Error
/// naming `where` and the field. Whether the values are within the limits is a matter for CommandGuard.
RobotCommand parse_command_line(std::string_view line, const std::string& where);

/// The commands of a file of such lines, whose time stamps must rise. Throws Error naming file and line.
std::vector<RobotCommand> read_command_lines(const std::string& path);

}  // namespace glovebench
