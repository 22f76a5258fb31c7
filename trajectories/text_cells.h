#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

/// Without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);
/// The parts of `text` between the separators, trimmed.
std::vector<std::string_view> split(std::string_view text, char separator);
/// The lines of a text file, trimmed of spaces and carriage returns at their ends, without a byte order mark before
/// them (spreadsheets begin a UTF-8 file with one).
std::vector<std::string_view> lines_of(std::string_view text);

/// The number that the whole cell is, if it is one; may be NaN or infinite.
std::optional<double> number_in(std::string_view cell);
/// The number in a cell from `min` to `max`. Throws Error naming `where` and `field`.
double number_from(std::string_view cell, double min, double max, const std::string& where,
                   const std::string& field);

}  // namespace glovebench::trajectories
