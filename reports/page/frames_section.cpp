#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "reports/page/page.h"
#include "reports/page/section.h"
#include "reports/summary.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

const std::array<Column, 3> kErrors = {{{"position_error_mm", "position mm"},
                                        {"posture_rms_deg", "posture deg"},
                                        {"rotation_error_deg", "rotation deg"}}};

/// The first of those with the largest error; empty if no frame has one.
std::optional<WorstFrame> worst_frame(const ExperimentResult& experiment, const std::string& metric) {
  std::optional<WorstFrame> worst;
  for (const SeedRun& run : experiment.runs)
    for (const FrameRecord& frame : run.frames)
      if (frame[metric] && (!worst || *frame[metric] > *worst->frame[metric]))
        worst = WorstFrame{experiment.key, run.seed, frame, metric};
  return worst;
}

/// An error frame by frame, from 0 to `largest`; gaps are lost frames.
std::string curve_plot(const SeedRun& run, const std::string& metric, double largest) {
  constexpr double kWidth = 480, kHeight = 36;
  const double step = kWidth / std::max(static_cast<double>(run.frames.size()) - 1, 1.0);
  const double scale = largest > 0 ? kHeight / largest : 0;
  std::string path;
  bool is_line = false;
  for (size_t f = 0; f < run.frames.size(); ++f) {
    const std::optional<double>& error = run.frames[f][metric];
    if (error)
      path += fmt::format("{}{:.1f} {:.1f}{}", is_line ? 'L' : 'M', step * static_cast<double>(f),
                          kHeight - scale * *error, is_line ? "" : "h0");  // shows a frame between gaps as a dot
    is_line = error.has_value();
  }
  return fmt::format(
      "<svg class=\"curve\" viewBox=\"0 -2 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "aria-hidden=\"true\"><path d=\"{2}\"/></svg>",
      kWidth, kHeight + 4, path);
}

/// A foldable part whose id is "frames-" and the experiment's name.
std::string frames_html(const ExperimentResult& experiment, const PageMaterial& material) {
  Table table = table_of({"error", "mean", "largest", "in frame", "noise seed"});
  std::vector<std::string> plots, commands;
  for (const Column& error : kErrors) {
    const std::optional<WorstFrame> worst = worst_frame(experiment, error.key);
    if (!worst) continue;
    const double largest = *worst->frame[error.key];
    table.rows.push_back({error.heading, fixed(experiment.aggregate_of(error.key).mean, 2), fixed(largest, 2),
                          worst->frame.frame, static_cast<int64_t>(worst->seed)});
    plots.push_back(curve_plot(experiment.runs.front(), error.key, largest));
    if (material.worst_frames.empty()) continue;
    if (const std::string command = explain_command(*worst, material.from_files);
        std::ranges::count(commands, command) == 0)
      commands.push_back(command);
  }
  std::vector<std::string> names;
  for (const Cell& name : experiment_names(experiment.key)) names.push_back(cell_text(name, {}));
  const std::string name = to_string(experiment.key);
  return fmt::format("<details id=\"frames-{}\"><summary>{}: {} of {} frames lost</summary>\n", escape_html(name),
                     escape_html(fmt::format("{}", fmt::join(names, ", "))), experiment.coverage.lost,
                     experiment.coverage.frames) +
         (plots.empty() ? "" : to_html(table, plots)) +
         (commands.empty() ? ""
                           : "<pre>" + escape_html(fmt::format("{}", fmt::join(commands, "\n"))) + "</pre>\n") +
         data_note("frames_" + name) + "</details>\n";
}

}  // namespace

Section frames_section(const RunResult& result, const PageMaterial& material) {
  std::string html =
      "<p>Curves go from 0 to the largest error; gaps are lost frames; of several noise seeds they show the first.";
  if (!material.worst_frames.empty()) {
    html += " The commands show every stage of the worst frames; run them in this folder.";
    if (!material.from_files.empty()) html += " PATH stands for the folder of a file that the run was given.";
  }
  html += "</p>\n";
  for (const ExperimentResult& experiment : result.experiments) html += frames_html(experiment, material);
  return {"frames", "Frame by frame", html};
}

}  // namespace glovebench::reports
