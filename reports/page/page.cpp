#include "reports/page/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/metrics/glossary.h"
#include "reports/page/section.h"
#include "reports/summary.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

Section metrics_section(const RunResult& result) {
  return {"metrics", "More metrics",
          "<p>Intervals are over blocks of frames and, where there are several, noise seeds; not over movements or "
          "hands.</p>\n" +
              to_html_with_links(detail_summary(result)) + data_note("metrics")};
}

Section glossary_section() {
  return {"glossary", "Glossary of metrics",
          "<p>Primes mark the estimate, the rest is the truth. \"Compared\" are those that compare, table and the "
          "gate judge. What one study alone measures is explained above its table.</p>\n" +
              glossary_html()};
}

Section command_section(const RunResult& result, const Timings& timings) {
  std::string html = "<p>" + escape_html(command_explanation()) + "</p>\n<h3>The stream</h3>\n";
  html += to_html_with_links(command_stream_table(result)) + "<h3>Interventions</h3>\n";
  const Table interventions = command_intervention_table(result);
  html += interventions.rows.empty() ? "<p>None.</p>\n" : to_html_with_links(interventions);
  html += "<h3>Against the truth's commands</h3>\n" + to_html_with_links(command_error_table(result)) +
          data_note("commands");
  if (const Table latency = command_latency_table(result, timings); !latency.rows.empty())
    html +=
        "<h3>From frame to command</h3>\n<p>Processor time from a frame of the device to its command: tracking, "
        "mapping, arm and guard, without transport. It differs from run to run.</p>\n" +
        to_html(latency);
  return {"commands", "Robot commands", html};
}

Section gallery_section(const std::vector<Picture>& pictures) {
  std::string html =
      "<p>Frames with the largest position and posture errors, at most two of an experiment, with every stage of "
      "the tracker. The command under each shows it again; run it in this folder.</p>\n<div class=\"gallery\">\n";
  for (const Picture& picture : pictures) {
    const std::string caption = escape_html(picture.caption);
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"{1}\"/><figcaption>{0}</figcaption><code "
        "tabindex=\"0\">{2}</code></figure>\n",
        caption, data_uri(picture.image), escape_html(picture.command));
  }
  return {"worst", "The worst frames", html + "</div>\n"};
}

Section configuration_section(const RunResult& result) {
  return {"configuration", "Configuration",
          "<details><summary>The effective configuration (config.json)</summary>\n<pre>" +
              escape_html(format_json(result.configuration)) + "</pre></details>\n"};
}

Section environment_section(const Timings& timings) {
  Table table = table_of({"", ""}, 2);
  table.rows = {{"host", timings.host},
                {"processor", timings.processor},
                {"threads", timings.threads},
                {"compiler", timings.compiler},
                {"build", timings.build_type},
                {"commit", timings.commit},
                {"date", timings.date},
                {"duration", fixed(timings.wall_s, 0) + " s"},
                {"peak memory", fixed(timings.peak_memory_mb, 0) + " MB"}};
  return {"environment", "Environment", "<p>All times of this page were measured here.</p>\n" + to_html(table)};
}

std::vector<Section> all_sections(const RunResult& result, const PaperNumbers& paper, const Timings& timings,
                                  const PageMaterial& material) {
  std::vector<Section> sections = experiment_sections(result, paper, material.sheets);
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  // A quick run judges no claims, but shows the section of a whole run.
  if (any_was_run(verdicts) || !quick_note(result).empty())
    sections.push_back({"claims", "Claims", claims_section(verdicts)});
  for (Section& section : study_sections(result)) sections.push_back(std::move(section));
  if (!result.experiments.empty()) sections.push_back(frames_section(result, material));
  if (!result.experiments.empty()) sections.push_back(metrics_section(result));
  if (has_commands(result)) sections.push_back(command_section(result, timings));
  if (!material.worst_frames.empty()) sections.push_back(gallery_section(material.worst_frames));
  if (!result.experiments.empty() || !result.studies.empty()) sections.push_back(glossary_section());
  sections.push_back(configuration_section(result));
  if (!result.studies.empty()) sections.push_back(environment_section(timings));
  return sections;
}

std::string section_html(const Section& section) {
  const bool has_heading = section.html.starts_with("<h2>");
  return fmt::format("<section id=\"{}\">\n{}{}</section>\n", section.id,
                     has_heading ? "" : "<h2>" + escape_html(section.title) + "</h2>\n", section.html);
}

/// Links to the sections.
std::string contents_list(const std::vector<Section>& sections) {
  std::string html = "<nav aria-label=\"Contents\"><ul>\n";
  for (const Section& section : sections)
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escape_html(section.title));
  return html + "</ul></nav>\n";
}

constexpr int kPerExperiment = 2;
constexpr int64_t kApartUs = 500'000;

bool is_preferred(const ExperimentKey& key, const NoiseSetting& noise) {
  return key.truth == TruthKind::source && key.subject == 1 && key.noise == noise;
}

/// All frames with this error, largest first, then earliest.
std::vector<WorstFrame> ranked(const std::vector<const ExperimentResult*>& experiments, std::string_view metric) {
  std::vector<WorstFrame> frames;
  for (const ExperimentResult* experiment : experiments)
    for (const SeedRun& run : experiment->runs)
      for (const FrameRecord& frame : run.frames)
        if (frame[metric]) frames.push_back({experiment->key, run.seed, frame, std::string(metric)});
  std::ranges::stable_sort(
      frames, [&](const WorstFrame& a, const WorstFrame& b) { return *a.frame[metric] > *b.frame[metric]; });
  return frames;
}

bool may_join(const std::vector<WorstFrame>& chosen, const WorstFrame& candidate) {
  int of_experiment = 0;
  for (const WorstFrame& other : chosen) {
    if (other.key != candidate.key) continue;
    ++of_experiment;
    if (std::abs(other.frame.timestamp_us - candidate.frame.timestamp_us) < kApartUs) return false;
  }
  return of_experiment < kPerExperiment;
}

}  // namespace

std::string data_note(const std::string& table) {
  return fmt::format("<p class=\"source\">Data: <a href=\"tables/{0}.csv\">tables/{0}.csv</a></p>\n",
                     escape_html(table));
}

std::string html_page(const RunResult& result, const PaperNumbers& paper, const Timings& timings,
                      const PageMaterial& material) {
  const std::vector<Section> sections = all_sections(result, paper, timings, material);
  const std::string note = quick_note(result);
  std::string body =
      fmt::format("<p class=\"provenance\">glovebench {}, commit {}, protocol {}, run {}</p>\n",
                  escape_html(result.program_version), escape_html(result.commit), result.protocol.id(),
                  escape_html(run_name(result))) +
      "<noscript><p>The charts are drawn by scripts; the tables hold all of their numbers.</p></noscript>\n" +
      (note.empty() ? "" : "<p><strong>" + escape_html(note) + "</strong></p>\n");
  for (const std::string& warning : material.warnings)
    body += "<p><strong>Warning:</strong> " + escape_html(warning) + "</p>\n";
  body += contents_list(sections);
  for (const Section& section : sections) body += section_html(section);
  body += "<p class=\"provenance\">The paper: " + escape_html(paper.source) + ".</p>\n";
  return html_document("glovebench results", body, sheet_style(material.sheets),
                       chart_scripts(csv_tables(result, paper), material.scripts));
}

std::vector<WorstFrame> worst_frames(const RunResult& result, int count) {
  const NoiseSetting noise = headline_noise(result);
  std::vector<const ExperimentResult*> all, preferred;
  for (const ExperimentResult& experiment : result.experiments) {
    all.push_back(&experiment);
    if (is_preferred(experiment.key, noise)) preferred.push_back(&experiment);
  }
  const auto worst_of = [&](const std::vector<const ExperimentResult*>& experiments) {
    std::vector<WorstFrame> chosen;
    const auto add = [&](std::string_view metric, int most) {
      for (const WorstFrame& candidate : ranked(experiments, metric))
        if (static_cast<int>(chosen.size()) < most && may_join(chosen, candidate)) chosen.push_back(candidate);
    };
    add("position_error_mm", count / 2);
    add("posture_rms_deg", static_cast<int>(chosen.size()) + count - count / 2);
    return chosen;
  };
  const std::vector<WorstFrame> chosen = worst_of(preferred);
  return chosen.empty() ? worst_of(all) : chosen;
}

std::string explain_command(const WorstFrame& worst, const std::set<std::string>& from_files,
                            const std::string& folder) {
  std::string command = fmt::format("glovebench explain {} {} --experiment {} --seed {}", shell_quoted(folder),
                                    worst.frame.frame, shell_quoted(to_string(worst.key)), worst.seed);
  const auto add_file = [&](const std::string& input, const std::string& flag, const std::string& name) {
    if (from_files.contains(input)) command += fmt::format(" {} {}", flag, shell_quoted("PATH/" + name));
  };
  add_file(truth_name(worst.key), "--trajectory", worst.key.trajectory + ".json");
  add_file(worst.key.database, "--database", worst.key.database);
  return command;
}

std::string caption(const WorstFrame& worst) {
  return fmt::format("{} with {}, {} truth, frame {}, noise seed {}: {} mm, posture {} deg, rotation {} deg",
                     worst.key.trajectory, worst.key.database, to_string(worst.key.truth), worst.frame.frame,
                     worst.seed, fixed(worst.frame["position_error_mm"], 1),
                     fixed(worst.frame["posture_rms_deg"], 1), fixed(worst.frame["rotation_error_deg"], 1));
}

}  // namespace glovebench::reports
