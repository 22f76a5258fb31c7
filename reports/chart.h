#pragma once

#include <optional>
#include <string>
#include <vector>

namespace glovebench::reports {

/// A line over equidistant places 0, 1, 2, ...; no value leaves a gap.
struct Series {
  std::string name;
  std::vector<std::optional<double>> values;
};

/// A line chart whose y axis starts at zero or, if it is signed, includes it.
struct LineChart {
  std::string title;
  std::string x_label;
  std::string y_label;  ///< with its unit
  std::vector<Series> series;
  bool is_signed = false;
  int first_place = 0;  ///< the number of place 0 on the x axis
};

/// The chart as inline SVG. Series i has the classes "line" and "series-i", axes and texts "axis", "grid", "label":
/// their look is up to the page's style sheet. Throws std::logic_error if a value is not finite, or negative in a
/// chart that is not signed.
std::string to_svg(const LineChart& chart);

/// About `count` round numbers (1, 2 or 5 times a power of ten apart) from 0 to at least `max`.
std::vector<double> axis_ticks(double max, int count);
/// The same from at most `min` to at least `max`, over zero.
std::vector<double> signed_axis_ticks(double min, double max, int count);

}  // namespace glovebench::reports
