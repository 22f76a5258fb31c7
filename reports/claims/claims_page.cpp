#include <fmt/format.h>

#include <algorithm>

#include "reports/claims/claims_report.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// Class of the page's style.
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
    case ClaimOutcome::withdrawn:
      break;
  }
  return "unsure";
}

/// "2026-11-21, commit d87120a"
std::string when(const std::string& date, const std::optional<std::string>& commit) {
  return commit ? fmt::format("{}, commit {}", date, *commit) : date;
}

std::string field_text(const ClaimDefinition& definition, const std::string& field) {
  const nlohmann::ordered_json json = field_json(definition, field);
  return json.is_string() ? json.get<std::string>() : json.dump();
}

/// Old value, if any, and new value of a field.
std::string change_html(const ClaimChange* before, const ClaimChange& after, const std::string& field) {
  const std::string old_text = before ? field_text(before->definition, field) : "";
  const std::string old_html = old_text.empty() ? "" : fmt::format("<del>{}</del> ", escape_html(old_text));
  return fmt::format("<br/>{}: {}<ins>{}</ins>", field, old_html, escape_html(field_text(after.definition, field)));
}

std::string entry_html(const ClaimChange* before, const ClaimChange& change) {
  std::string html = fmt::format("<li><b>{}</b>: {}", when(change.date, change.commit), escape_html(change.why));
  for (const std::string& field : change.set) html += change_html(before, change, field);
  return fmt::format("{}<br/>Came out: {}</li>\n", html, escape_html(change.came_out.value_or("no run published")));
}

std::string history_html(const Claim& claim) {
  const int changes = change_count(claim);
  std::string html = fmt::format("<details class=\"history\"><summary>History: {}</summary><ol>\n",
                                 changes == 0   ? "never changed"
                                 : changes == 1 ? "changed once"
                                                : fmt::format("changed {} times", changes));
  const ClaimChange* before = nullptr;
  for (const ClaimChange& change : claim.history) {
    html += entry_html(before, change);
    before = &change;
  }
  return html + "</ol></details>";
}

std::string row_html(const ClaimVerdict& verdict) {
  const ClaimDefinition& claim = verdict.claim.definition();
  const std::string note =
      css_class(verdict.outcome) == "worse" ? "<br/><b>" + escape_html(claim.if_not) + "</b>" : "";
  return fmt::format(
      "<tr id=\"claim-{}\"><td class=\"name verdict {}\">{}{}</td><td "
      "class=\"name\">{}<br/><small>{}</small>{}{}</td>"
      "<td class=\"name\">{}{}<br/><small>{}</small></td><td>{}</td><td>{}</td></tr>\n",
      escape_html(verdict.claim.id), css_class(verdict.outcome), to_string(verdict.outcome),
      claim.required ? "<br/>required *" : "", escape_html(claim.claim), escape_html(claim.measured), note,
      history_html(verdict.claim),
      claim.quote.empty() ? "" : fmt::format("<q>{}</q><br/>", escape_html(claim.quote)),
      escape_html(claim.paper_value), escape_html(claim.source), escape_html(measured_text(verdict)),
      escape_html(rule_text(verdict)));
}

/// The claims with one of the outcomes, in the order of the outcomes; empty if there are none.
std::string table_html(const std::vector<ClaimVerdict>& verdicts, const std::vector<ClaimOutcome>& outcomes) {
  std::string html =
      "<div class=\"scroll\"><table class=\"claims\">\n<thead><tr>"
      "<th class=\"name\">outcome</th><th class=\"name\">claim</th><th class=\"name\">paper</th>"
      "<th>measured</th><th>holds if</th></tr></thead>\n<tbody>\n";
  std::string rows;
  for (const ClaimOutcome outcome : outcomes)
    for (const ClaimVerdict& verdict : verdicts)
      if (verdict.outcome == outcome) rows += row_html(verdict);
  return rows.empty() ? "" : html + rows + "</tbody></table></div>\n";
}

std::string folded_html(const std::vector<ClaimVerdict>& verdicts, std::string_view title,
                        const std::vector<ClaimOutcome>& outcomes) {
  const std::string table = table_html(verdicts, outcomes);
  if (table.empty()) return "";
  const auto count = std::ranges::count_if(
      verdicts, [&](const ClaimVerdict& verdict) { return std::ranges::count(outcomes, verdict.outcome) > 0; });
  return fmt::format("<details><summary>{}: {}</summary>\n{}</details>\n", title, count, table);
}

std::string judging_html() {
  std::string html = "<details><summary>How claims were judged before</summary><ol>\n";
  for (const JudgingChange& change : claim_set().judging)
    html += fmt::format("<li><b>{}</b>: {}<br/><ins>{}</ins></li>\n", when(change.date, change.commit),
                        escape_html(change.why), escape_html(change.rule));
  return html + "</ol></details>\n";
}

}  // namespace

std::string claims_section(const std::vector<ClaimVerdict>& verdicts) {
  const std::string html = fmt::format("<h2>Claims</h2>\n<p>{}. {}. {}. {}</p>\n",
                                       escape_html(count_text(verdicts)), escape_html(required_text(verdicts)),
                                       escape_html(chance_text(verdicts)), escape_html(judging_text()));
  return html +
         table_html(verdicts,
                    {ClaimOutcome::not_reproduced, ClaimOutcome::not_consistent, ClaimOutcome::inconclusive}) +
         folded_html(verdicts, "Hold", {ClaimOutcome::reproduced, ClaimOutcome::consistent}) +
         folded_html(verdicts, "Withdrawn", {ClaimOutcome::withdrawn}) +
         folded_html(verdicts, "Not run", {ClaimOutcome::not_run}) + judging_html();
}

}  // namespace glovebench::reports
