#include "reports/claims/claims_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/chart.h"
#include "reports/csv.h"
#include "reports/json_text.h"
#include "reports/statistics_json.h"
#include "reports/summary.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<ClaimOutcome, 6> kOutcomes = {ClaimOutcome::reproduced,   ClaimOutcome::not_reproduced,
                                                   ClaimOutcome::consistent,   ClaimOutcome::not_consistent,
                                                   ClaimOutcome::inconclusive, ClaimOutcome::not_run};

bool has_failed(const ClaimVerdict& verdict) {
  return verdict.outcome == ClaimOutcome::not_reproduced || verdict.outcome == ClaimOutcome::not_consistent;
}

/// Of the page's style.
std::string_view css_class(ClaimOutcome outcome) {
  switch (outcome) {
    case ClaimOutcome::reproduced:
    case ClaimOutcome::consistent:
      return "better";
    case ClaimOutcome::not_reproduced:
    case ClaimOutcome::not_consistent:
      return "worse";
    case ClaimOutcome::inconclusive:
    case ClaimOutcome::not_run:
      break;
  }
  return "unsure";
}

std::string with_unit(const std::string& text, const ClaimVerdict& verdict) {
  if (!verdict.measure || verdict.measure->unit.empty()) return text;
  return text + " " + verdict.measure->unit;
}

std::string ids_of(const std::vector<ClaimVerdict>& verdicts, ClaimOutcome outcome) {
  std::vector<std::string> ids;
  for (const ClaimVerdict& verdict : verdicts)
    if (verdict.outcome == outcome) ids.push_back(verdict.claim.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

/// The claims that were run. What a cell holds is escaped by whoever writes the table.
TextTable verdict_table(const std::vector<ClaimVerdict>& verdicts) {
  TextTable table;
  table.heading = {"outcome", "claim", "source", "paper", "measured", "holds if"};
  table.name_columns = 4;
  for (const ClaimVerdict& verdict : verdicts) {
    if (verdict.outcome == ClaimOutcome::not_run) continue;
    const Claim& claim = verdict.claim;
    table.rows.push_back({fmt::format("{}{}", to_string(verdict.outcome), claim.required ? ", required" : ""),
                          claim.claim + " " + claim.measured + (has_failed(verdict) ? " " + claim.if_not : ""),
                          claim.source, claim.paper_value.empty() ? "-" : claim.paper_value, measured_text(verdict),
                          rule_text(verdict)});
  }
  return table;
}

constexpr std::string_view kExplanation =
    "Each claim of the paper has a rule. Those about Figures 4 to 6 and 15 Hz were written down when first results "
    "of "
    "this program were known, the others before. A claim is reproduced if the whole "
    "95% interval of what was measured satisfies the rule, not reproduced if none of it does, and inconclusive in "
    "between; a number without an interval is judged by itself. Consistent says less: the experiment is not the "
    "paper's.";

Json verdict_json(const ClaimVerdict& verdict) {
  const Claim& claim = verdict.claim;
  Json measure = nullptr;
  if (verdict.measure) {
    measure = {{"name", verdict.measure->name},
               {"unit", verdict.measure->unit},
               {"value", rounded_or_null(verdict.measure->value)},
               {"interval", interval_json(verdict.measure->interval)},
               {"is_time", verdict.measure->is_time}};
  }
  return {{"id", claim.id},
          {"outcome", to_string(verdict.outcome)},
          {"required", claim.required},
          {"kind", to_string(claim.kind)},
          {"claim", claim.claim},
          {"source", claim.source},
          {"paper_value", claim.paper_value},
          {"measured", claim.measured},
          {"rule", to_string(claim.rule)},
          {"measure_name", claim.measure},
          {"measure", std::move(measure)},
          {"if_not", claim.if_not}};
}

Json csv_row(const ClaimVerdict& verdict) {
  const Claim& claim = verdict.claim;
  Json row = {claim.id,     to_string(verdict.outcome), claim.required, to_string(claim.kind),
              claim.source, claim.paper_value,          claim.measure,  to_string(claim.rule)};
  const auto& measure = verdict.measure;
  row.push_back(measure ? Json(measure->unit) : Json());
  row.push_back(measure ? rounded_or_null(measure->value) : Json());
  row.push_back(measure && measure->interval ? Json(rounded(measure->interval->low)) : Json());
  row.push_back(measure && measure->interval ? Json(rounded(measure->interval->high)) : Json());
  row.push_back(claim.claim);
  return row;
}

}  // namespace

std::string measured_text(const ClaimVerdict& verdict) {
  if (!verdict.measure || !verdict.measure->value) return "-";
  // Counts, shares and errors stand in one column: four digits tell each of them.
  std::string text = fmt::format("{:.4g}", rounded(*verdict.measure->value));
  if (const auto& interval = verdict.measure->interval)
    text += fmt::format(" [{:.4g}, {:.4g}]", rounded(interval->low), rounded(interval->high));
  return with_unit(text, verdict);
}

std::string rule_text(const ClaimVerdict& verdict) {
  return with_unit(to_string(verdict.claim.rule), verdict);
}

std::string count_text(const std::vector<ClaimVerdict>& verdicts) {
  std::vector<std::string> counts;
  for (const ClaimOutcome outcome : kOutcomes) {
    const auto count = std::ranges::count(verdicts, outcome, &ClaimVerdict::outcome);
    if (count > 0) counts.push_back(fmt::format("{} {}", count, to_string(outcome)));
  }
  return fmt::format("{} claims: {}", verdicts.size(), fmt::join(counts, ", "));
}

std::string claims_table(const std::vector<ClaimVerdict>& verdicts) {
  std::string text = count_text(verdicts) + " (* required)\n", notes;
  for (const ClaimVerdict& verdict : verdicts) {
    if (verdict.outcome == ClaimOutcome::not_run) continue;
    text +=
        fmt::format("{:<15}{} {:<34} {:<32} {}\n", to_string(verdict.outcome), verdict.claim.required ? "*" : " ",
                    verdict.claim.id, measured_text(verdict), rule_text(verdict));
    if (has_failed(verdict)) notes += fmt::format("{}: {}\n", verdict.claim.id, verdict.claim.if_not);
  }
  return text + notes;
}

std::string claims_markdown(const std::vector<ClaimVerdict>& verdicts) {
  if (!any_was_run(verdicts)) return "";
  const std::string not_run = ids_of(verdicts, ClaimOutcome::not_run);
  return fmt::format("## Claims\n\n{}. {}\n\n{}\n{}", count_text(verdicts), kExplanation,
                     to_markdown(verdict_table(verdicts)),
                     not_run.empty() ? "" : fmt::format("Not run: {}.\n\n", not_run));
}

std::string claims_csv(const std::vector<ClaimVerdict>& verdicts) {
  std::string csv =
      "id,outcome,required,kind,source,paper_value,measure,rule,unit,value,value_low,value_high,claim\n";
  for (const ClaimVerdict& verdict : verdicts) csv += csv_line(csv_row(verdict));
  return csv;
}

std::string claims_json(const std::vector<ClaimVerdict>& verdicts) {
  Json json = Json::array();
  for (const ClaimVerdict& verdict : verdicts) json.push_back(verdict_json(verdict));
  return format_json({{"format", "glovebench-verdicts"},
                      {"version", 1},
                      {"required_claim_failed", required_claim_failed(verdicts)},
                      {"verdicts", std::move(json)}});
}

std::string claims_section(const std::vector<ClaimVerdict>& verdicts) {
  if (!any_was_run(verdicts)) return "";
  std::string html = fmt::format(
      "<h2>Claims</h2>\n<p>{}. {}</p>\n<div class=\"scroll\"><table class=\"claims\">\n<thead><tr>"
      "<th class=\"name\">outcome</th><th class=\"name\">claim</th><th class=\"name\">paper</th>"
      "<th>measured</th><th>holds if</th></tr></thead>\n<tbody>\n",
      escape_html(count_text(verdicts)), escape_html(std::string(kExplanation)));
  for (const ClaimVerdict& verdict : verdicts) {
    if (verdict.outcome == ClaimOutcome::not_run) continue;
    const Claim& claim = verdict.claim;
    const std::string note = has_failed(verdict) ? "<br/><b>" + escape_html(claim.if_not) + "</b>" : "";
    html += fmt::format(
        "<tr><td class=\"name verdict {}\">{}{}</td><td class=\"name\">{}<br/><small>{}</small>{}</td>"
        "<td class=\"name\">{}<br/><small>{}</small></td><td>{}</td><td>{}</td></tr>\n",
        css_class(verdict.outcome), to_string(verdict.outcome), claim.required ? "<br/>required" : "",
        escape_html(claim.claim), escape_html(claim.measured), note, escape_html(claim.paper_value),
        escape_html(claim.source), escape_html(measured_text(verdict)), escape_html(rule_text(verdict)));
  }
  html += "</tbody></table></div>\n";
  const std::string not_run = ids_of(verdicts, ClaimOutcome::not_run);
  return html +
         (not_run.empty() ? "" : fmt::format("<p class=\"legend\">Not run: {}.</p>\n", escape_html(not_run)));
}

}  // namespace glovebench::reports
