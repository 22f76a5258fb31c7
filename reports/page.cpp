#include "reports/page.h"

#include <fmt/format.h>

#include "reports/chart.h"
#include "reports/claims/claims_report.h"
#include "reports/summary.h"

namespace glovebench::reports {
namespace {

/// One error of the experiment's first seed over the paper's curve.
std::string error_chart(const ExperimentResult& experiment, std::string_view metric, const std::string& label,
                        const PaperCurve& paper, double PaperErrors::*paper_value) {
  LineChart chart{fmt::format("{} of {} with {}", label, paper.trajectory, paper.database), "frame", label, {}};
  chart.series = {{"glovebench", {}}, {"paper", {}}};
  for (const FrameRecord& frame : experiment.runs.front().frames)
    chart.series[0].values.push_back(frame.*metrics()[metric_index(metric)].value);
  for (const PaperErrors& errors : paper.frames) chart.series[1].values.push_back(errors.*paper_value);
  return to_svg(chart);
}

std::string curve_section(const RunResult& result, const NoiseSetting& noise, const std::string& figure,
                          const PaperCurve& paper) {
  const ExperimentResult* experiment =
      find_experiment(result, {paper.trajectory, paper.database, TruthKind::recorded, 1, noise});
  if (!experiment || experiment->runs.empty()) return "";
  return fmt::format("<h2>{}: {} with {}, recorded truth</h2>\n", figure, paper.trajectory, paper.database) +
         "<p class=\"legend\"><span class=\"key series-0\"></span>glovebench, frame by frame; gaps are lost frames "
         "<span class=\"key series-1\"></span>the paper's own movement, for the shape and size of its "
         "errors</p>\n" +
         error_chart(*experiment, "position_error_mm", "position error (mm)", paper, &PaperErrors::position_mm) +
         error_chart(*experiment, "posture_rms_deg", "posture error (deg)", paper, &PaperErrors::posture_deg) +
         error_chart(*experiment, "rotation_error_deg", "rotation error (deg)", paper, &PaperErrors::rotation_deg);
}

}  // namespace

std::string html_page(const RunResult& result, const PaperNumbers& paper, const std::vector<Picture>& pictures) {
  const NoiseSetting noise = headline_noise(result);
  const std::string body =
      fmt::format("<p class=\"provenance\">glovebench {}, commit {}, protocol {}</p>\n",
                  escape_html(result.program_version), escape_html(result.commit), result.protocol.id()) +
      claims_section(judge(claims(), all_measures(result))) + "<h2>Figure 4: mean errors</h2>\n<p>" +
      escape_html(fmt::format("{} Noise: {} x {}.", summary_explanation(), noise.model, noise.factor)) + "</p>\n" +
      to_html(figure4_summary(result, paper, noise)) + curve_section(result, noise, "Figure 5", paper.figure_5) +
      curve_section(result, noise, "Figure 6", paper.figure_6) + picture_section("Frames", pictures) +
      "<h2>More metrics</h2>\n<p>Intervals are over blocks of frames and, where there are several, noise seeds; "
      "not over movements or hands.</p>\n" +
      to_html(detail_summary(result)) + "<p class=\"provenance\">The paper: " + escape_html(paper.source) +
      ".</p>\n";
  return html_document("glovebench results", body);
}

}  // namespace glovebench::reports
