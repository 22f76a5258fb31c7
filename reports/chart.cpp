#include "reports/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

// The chart's box in SVG units.
constexpr double kWidth = 760, kHeight = 190;
constexpr double kLeft = 52, kRight = 750, kTop = 26, kBottom = 156;

/// Where places and values lie in the box.
struct Scale {
  double x_max = 1;
  std::vector<double> y_ticks;
  double x(double place) const { return kLeft + (kRight - kLeft) * place / x_max; }
  double y(double value) const {
    return kBottom - (kBottom - kTop) * (value - y_ticks.front()) / (y_ticks.back() - y_ticks.front());
  }
};

Scale make_scale(const LineChart& chart) {
  size_t places = 2;
  double smallest = 0, largest = 0;
  for (const Series& series : chart.series) {
    places = std::max(places, series.values.size());
    for (const auto& value : series.values) {
      if (!value) continue;
      check(std::isfinite(*value), "a chart shows finite values");
      check(chart.is_signed || *value >= 0, "a chart that is not signed shows values of 0 or more");
      smallest = std::min(smallest, *value);
      largest = std::max(largest, *value);
    }
  }
  return {static_cast<double>(places - 1), signed_axis_ticks(smallest, largest, 4)};
}

std::string text(double x, double y, const char* anchor, const std::string& label) {
  return fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escape_html(label));
}

std::string line(const char* style, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style, x1,
                     y1, x2, y2);
}

std::string axes(const LineChart& chart, const Scale& scale) {
  std::string svg;
  for (const double tick : scale.y_ticks) {
    svg += line("grid", kLeft, scale.y(tick), kRight, scale.y(tick));
    svg += text(kLeft - 6, scale.y(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  // Round numbers of the first place on, not round distances from it.
  const double last_place = chart.first_place + scale.x_max;
  const double step = axis_ticks(scale.x_max, 8)[1];
  for (double tick = std::ceil(chart.first_place / step) * step; tick <= last_place; tick += step) {
    const double x = scale.x(tick - chart.first_place);
    svg += line("axis", x, kBottom, x, kBottom + 4);
    svg += text(x, kBottom + 17, "middle", fmt::format("{:g}", tick));
  }
  svg += line("axis", kLeft, scale.y(0), kRight, scale.y(0));
  svg += text(kLeft, kTop - 12, "start", chart.y_label);
  svg += text((kLeft + kRight) / 2, kHeight - 3, "middle", chart.x_label);
  return svg;
}

/// One path whose pen is lifted over gaps; a value between two gaps becomes a dot by its round line cap.
std::string path(const Series& series, size_t index, const Scale& scale) {
  std::string data;
  bool pen_down = false;
  for (size_t i = 0; i < series.values.size(); ++i) {
    if (series.values[i]) {
      const double x = scale.x(static_cast<double>(i)), y = scale.y(*series.values[i]);
      const bool alone = !pen_down && (i + 1 == series.values.size() || !series.values[i + 1]);
      data += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", x, y);
      if (alone) data += "h0";
    }
    pen_down = series.values[i].has_value();
  }
  return fmt::format("<path class=\"line series-{}\" d=\"{}\"/>\n", index, data);
}

}  // namespace

std::vector<double> axis_ticks(double max, int count) {
  return signed_axis_ticks(0, max, count);
}

std::vector<double> signed_axis_ticks(double min, double max, int count) {
  min = std::min(min, 0.0);
  max = std::max(max, 0.0);
  if (max - min <= 0) return {0, 1};
  const double raw_step = (max - min) / count;
  const double power = std::pow(10, std::floor(std::log10(raw_step)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= raw_step * (1 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  const double first = std::ceil(-min / step * (1 - 1e-9)), last = std::ceil(max / step * (1 - 1e-9));
  for (double i = -first; i <= last; ++i) ticks.push_back(step * i + 0.0);  // + 0.0 turns -0 into 0
  return ticks;
}

std::string to_svg(const LineChart& chart) {
  const Scale scale = make_scale(chart);
  std::string svg = fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\">\n<title>{}</title>\n",
                                kWidth, kHeight, escape_html(chart.title));
  svg += axes(chart, scale);
  // The first series is drawn last: it is the one to look at.
  for (size_t i = chart.series.size(); i-- > 0;) svg += path(chart.series[i], i, scale);
  return svg + "</svg>\n";
}

}  // namespace glovebench::reports
