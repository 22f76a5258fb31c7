#include "reports/page/track_page.h"

#include <fmt/format.h>

#include <array>

#include "reports/page/page_frame.h"
#include "reports/table.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

Table status_table(const std::vector<Estimate>& estimates) {
  std::array<int, kCountOf<TrackStatus>> counts{};
  for (const Estimate& estimate : estimates) ++counts[static_cast<size_t>(estimate.status)];
  Table table = table_of({"status", "frames"});
  for (const TrackStatus status : all_values<TrackStatus>())
    if (const int count = counts[static_cast<size_t>(status)]; count > 0)
      table.rows.push_back({std::string(to_string(status)), std::to_string(count)});
  return table;
}

}  // namespace

std::string track_page(const std::string& title, const std::vector<Estimate>& estimates,
                       const std::vector<std::string>& scripts) {
  const std::string body =
      "<h2>Frames</h2>\n" + to_html(status_table(estimates)) +
      "<h2>Position</h2>\n<p>The hand's origin in the depth camera (x right, y down, z away). Gaps are lost "
      "frames.</p>\n" +
      chart_place("track-position", "Position over time") + "<h2>Angles</h2>\n" +
      chart_place("track-angles", "Angles over time");
  return html_document(title, body, "", chart_scripts({{"track", estimates_csv({{}, estimates})}}, scripts));
}

}  // namespace glovebench::reports
