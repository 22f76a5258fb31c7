#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

/// Without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);
/// No line of ours has as many cells.
inline constexpr size_t kMostCells = 1000;
/// The parts of `text` between the separators, trimmed. Beyond kMostCells the rest of the text is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The lines of a text file, one after the other, trimmed of spaces and carriage returns at their ends, without a
/// byte order mark before them (spreadsheets begin a UTF-8 file with one). An empty text is an empty line.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// Nothing after the last line.
  std::optional<std::string_view> next();
  /// Of the line that came last, from 1.
  size_t number() const { return number_; }

 private:
  std::optional<std::string_view> rest_;
  size_t number_ = 0;
};

/// The number that the whole cell is, if it is one; may be NaN or infinite.
std::optional<double> number_in(std::string_view cell);
/// The number in a cell from `min` to `max`. Throws Error naming `where` and `field`.
double number_from(std::string_view cell, double min, double max, const std::string& where,
                   const std::string& field);

/// `value` with a fixed number of decimals; the same on every machine, never "-0.000".
std::string fixed(double value, int decimals);

}  // namespace glovebench::trajectories
