#include "reports/page/page.h"

#include <fmt/format.h>

#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/json_text.h"
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
              to_html(detail_summary(result)) +
              "<details><summary>What each metric is</summary>\n<p>Primes mark the estimate, the rest is the truth."
              "</p>\n" +
              to_html(glossary_table()) + "</details>\n"};
}

Section command_section(const RunResult& result, const Timings& timings) {
  std::string html = "<p>" + escape_html(command_explanation()) + "</p>\n<h3>The stream</h3>\n";
  html += to_html(command_stream_table(result)) + "<h3>Interventions</h3>\n";
  const Table interventions = command_intervention_table(result);
  html += interventions.rows.empty() ? "<p>None.</p>\n" : to_html(interventions);
  html += "<h3>Against the truth's commands</h3>\n" + to_html(command_error_table(result)) + data_note("commands");
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
      "the "
      "tracker. The command under each shows it again; run it in this folder.</p>\n<div class=\"gallery\">\n";
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
  std::vector<Section> sections;
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  // A quick run judges no claims, but shows the section of a whole run.
  if (any_was_run(verdicts) || !quick_note(result).empty())
    sections.push_back({"claims", "Claims", claims_section(verdicts)});
  for (Section& section : experiment_sections(result, paper, material.sheets))
    sections.push_back(std::move(section));
  for (Section& section : study_sections(result)) sections.push_back(std::move(section));
  if (!result.experiments.empty()) sections.push_back(metrics_section(result));
  if (has_commands(result)) sections.push_back(command_section(result, timings));
  if (!material.worst_frames.empty()) sections.push_back(gallery_section(material.worst_frames));
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

}  // namespace

std::string data_note(const std::string& table) {
  return fmt::format("<p class=\"source\">Data: <a href=\"tables/{0}.csv\">tables/{0}.csv</a></p>\n", table);
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
      (note.empty() ? "" : "<p><strong>" + escape_html(note) + "</strong></p>\n") + contents_list(sections);
  for (const Section& section : sections) body += section_html(section);
  body += "<p class=\"provenance\">The paper: " + escape_html(paper.source) + ".</p>\n";
  return html_document("glovebench results", body, sheet_style(material.sheets),
                       chart_scripts(csv_tables(result, paper), material.scripts));
}

}  // namespace glovebench::reports
