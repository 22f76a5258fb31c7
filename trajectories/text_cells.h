#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

/// Without spaces, tabs and carriage returns at the ends.
std::string_view trimmed(std::string_view text);
inline constexpr size_t kMostCells = 1000;
/// Trimmed parts. After kMostCells the rest is one part.
std::vector<std::string_view> cells_of(std::string_view text, char separator);

/// Trimmed lines without byte order mark. An empty text is one empty line.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// Empty after the last line.
  std::optional<std::string_view> next();
  /// Of the last line, from 1.
  size_t number() const { return number_; }

 private:
  std::optional<std::string_view> rest_;
  size_t number_ = 0;
};

/// A row of a CSV.
struct CellRow {
  std::vector<std::string_view> cells;
  std::string place;  ///< "line 3"
};
/// Skips blank lines. Empty after the last row.
/// Throws: Error for another number of cells.
std::optional<CellRow> next_row(Lines& lines, size_t count, const std::string& where);

/// Throws: Error unless the cell is a number from `min` to `max`.
double number_from(std::string_view cell, double min, double max, const std::string& where,
                   const std::string& field);

/// The same on every machine. Never "-0.000".
std::string fixed(double value, int decimals);

}  // namespace glovebench::trajectories
