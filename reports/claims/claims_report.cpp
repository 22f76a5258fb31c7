#include "reports/claims/claims_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/statistics.h"
#include "reports/table.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kColumns = 80;
constexpr std::array<ClaimOutcome, 7> kOutcomes = {ClaimOutcome::reproduced,   ClaimOutcome::not_reproduced,
                                                   ClaimOutcome::consistent,   ClaimOutcome::not_consistent,
                                                   ClaimOutcome::inconclusive, ClaimOutcome::not_run,
                                                   ClaimOutcome::withdrawn};

bool has_failed(const ClaimVerdict& verdict) {
  return verdict.outcome == ClaimOutcome::not_reproduced || verdict.outcome == ClaimOutcome::not_consistent;
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

std::string quoted(const std::string& quote) { return quote.empty() ? "" : fmt::format("\"{}\"", quote); }

/// Quote and number; "-": neither.
std::string paper_text(const ClaimDefinition& claim) {
  if (claim.quote.empty()) return claim.paper_value.empty() ? "-" : claim.paper_value;
  return quoted(claim.quote) + (claim.paper_value.empty() ? "" : ": " + claim.paper_value);
}

/// Rows of the claims that were run.
Table verdict_table(const std::vector<ClaimVerdict>& verdicts) {
  Table table = table_of({"outcome", "claim", "source", "paper", "measured", "holds if"}, 4);
  for (const ClaimVerdict& verdict : verdicts) {
    if (verdict.outcome == ClaimOutcome::not_run) continue;
    const ClaimDefinition& claim = verdict.claim.definition();
    table.rows.push_back({fmt::format("{}{}", to_string(verdict.outcome), claim.required ? ", required" : ""),
                          claim.claim + " " + claim.measured + (has_failed(verdict) ? " " + claim.if_not : ""),
                          claim.source, paper_text(claim), measured_text(verdict), rule_text(verdict)});
  }
  return table;
}

Json or_null(const std::optional<std::string>& text) { return text ? Json(*text) : Json(); }

Json entry_json(const ClaimChange& change) {
  Json set = Json::object();
  for (const std::string& field : change.set) set[field] = field_json(change.definition, field);
  return {{"date", change.date},
          {"commit", or_null(change.commit)},
          {"set", std::move(set)},
          {"came_out", or_null(change.came_out)},
          {"why", change.why}};
}

Json judging_json(const JudgingChange& change) {
  return {{"date", change.date}, {"commit", or_null(change.commit)}, {"rule", change.rule}, {"why", change.why}};
}

Json verdict_json(const ClaimVerdict& verdict) {
  const ClaimDefinition& claim = verdict.claim.definition();
  Json measure = nullptr;
  if (verdict.measure) {
    measure = {{"name", verdict.measure->name},
               {"unit", verdict.measure->unit},
               {"value", rounded_or_null(verdict.measure->value)},
               {"interval", interval_json(verdict.measure->interval)},
               {"is_time", verdict.measure->is_time}};
  }
  Json json = {{"id", verdict.claim.id}, {"outcome", to_string(verdict.outcome)}};
  for (const char* field :
       {"required", "kind", "claim", "quote", "source", "paper_value", "measured", "rule", "ours"})
    json[field] = field_json(claim, field);
  json["holm_p"] = rounded_or_null(verdict.p);
  json["measure_name"] = claim.measure;
  json["measure"] = std::move(measure);
  json["if_not"] = claim.if_not;
  json["history"] = array_of(verdict.claim.history, entry_json);
  return json;
}

Json required_json(const RequiredClaims& count) {
  return {{"hold", count.hold},
          {"inconclusive", count.inconclusive},
          {"failed", count.failed},
          {"not_run", count.not_run}};
}

Json csv_row(const std::string& run, const ClaimVerdict& verdict) {
  const ClaimDefinition& claim = verdict.claim.definition();
  Json row = {run, verdict.claim.id, to_string(verdict.outcome)};
  for (const char* field : {"required", "kind", "source", "paper_value", "measure", "rule", "ours"})
    row.push_back(field_json(claim, field));
  const auto& measure = verdict.measure;
  row.push_back(measure ? Json(measure->unit) : Json());
  row.push_back(measure ? rounded_or_null(measure->value) : Json());
  row.push_back(measure && measure->interval ? Json(rounded(measure->interval->low)) : Json());
  row.push_back(measure && measure->interval ? Json(rounded(measure->interval->high)) : Json());
  row.push_back(rounded_or_null(verdict.p));
  row.push_back(claim.claim);
  row.push_back(claim.quote);
  return row;
}

}  // namespace

std::string measured_text(const ClaimVerdict& verdict) {
  if (!verdict.measure || !verdict.measure->value) return "-";
  // Counts, shares and errors share a column; four digits suffice for all.
  std::string text = fmt::format("{:.4g}", rounded(*verdict.measure->value));
  if (const auto& interval = verdict.measure->interval)
    text += fmt::format(" [{:.4g}, {:.4g}]", rounded(interval->low), rounded(interval->high));
  text = with_unit(text, verdict);
  return verdict.p ? fmt::format("{}, p {:.2g}", text, rounded(*verdict.p)) : text;
}

std::string rule_text(const ClaimVerdict& verdict) {
  const ClaimDefinition& claim = verdict.claim.definition();
  return with_unit(to_string(claim.rule), verdict) + (claim.ours ? " (ours)" : "");
}

std::string count_text(const std::vector<ClaimVerdict>& verdicts) {
  std::vector<std::string> counts;
  for (const ClaimOutcome outcome : kOutcomes) {
    const auto count = std::ranges::count(verdicts, outcome, &ClaimVerdict::outcome);
    if (count > 0) counts.push_back(fmt::format("{} {}", count, to_string(outcome)));
  }
  return fmt::format("{} claims: {}", verdicts.size(), fmt::join(counts, ", "));
}

std::string required_text(const std::vector<ClaimVerdict>& verdicts) {
  const auto [hold, inconclusive, failed, not_run] = count_required(verdicts);
  return fmt::format("{} required (*): {} hold, {} inconclusive, {} failed, {} not run",
                     hold + inconclusive + failed + not_run, hold, inconclusive, failed, not_run);
}

std::string chance_text(const std::vector<ClaimVerdict>& verdicts) {
  const auto count = std::ranges::count_if(verdicts, [](const ClaimVerdict& verdict) {
    return !verdict.claim.definition().required && verdict.outcome != ClaimOutcome::withdrawn && verdict.measure &&
           verdict.measure->interval;
  });
  return fmt::format(
      "Of {} other claims judged by a 95% interval, about {:.1f} ({} x 5%) would hold by chance even if none were "
      "true",
      count, 0.05 * static_cast<double>(count), count);
}

std::string judging_text() {
  const auto changed = std::ranges::count_if(claims(), [](const Claim& claim) { return change_count(claim) > 0; });
  return fmt::format(
      "{} The rules were written by the authors of this program: those about Figures 4 to 6 and 15 Hz when its "
      "first results were known, most others before, two claims later. {} of the {} claims were changed after they "
      "were first written, most when an outcome was known; the history of each says when, why, and what had come "
      "out.",
      claim_set().judging.back().rule, changed, claims().size());
}

std::string claims_table(const std::vector<ClaimVerdict>& verdicts) {
  std::string text, notes, quote;
  for (const std::string& line : {count_text(verdicts), required_text(verdicts), chance_text(verdicts)})
    text += wrapped(line, kColumns, 2);
  for (const ClaimVerdict& verdict : verdicts) {
    if (verdict.outcome == ClaimOutcome::not_run) continue;
    const ClaimDefinition& claim = verdict.claim.definition();
    if (claim.quote != quote) text += "\n" + wrapped(quoted(claim.quote), kColumns);
    quote = claim.quote;
    text += fmt::format("  {:<15}{} {}\n      {}; {}\n", to_string(verdict.outcome), claim.required ? "*" : " ",
                        verdict.claim.id, measured_text(verdict), rule_text(verdict));
    if (has_failed(verdict)) notes += wrapped(fmt::format("{}: {}", verdict.claim.id, claim.if_not), kColumns, 2);
  }
  return text + "\n" + notes;
}

std::string claims_markdown(const std::vector<ClaimVerdict>& verdicts) {
  if (!any_was_run(verdicts)) return "";
  const std::string not_run = ids_of(verdicts, ClaimOutcome::not_run);
  return fmt::format("## Claims\n\n{}. {}. {}. {} `claims.json` holds the histories.\n\n{}\n{}",
                     count_text(verdicts), required_text(verdicts), chance_text(verdicts), judging_text(),
                     to_markdown(verdict_table(verdicts)),
                     not_run.empty() ? "" : fmt::format("Not run: {}.\n\n", not_run));
}

std::string claims_csv(const std::string& run, const std::vector<ClaimVerdict>& verdicts) {
  std::string csv =
      "run,id,outcome,required,kind,source,paper_value,measure,rule,ours,unit,value,value_low,value_high,holm_p,"
      "claim,quote\n";
  for (const ClaimVerdict& verdict : verdicts) csv += csv_line(csv_row(run, verdict));
  return csv;
}

std::string claims_json(const std::vector<ClaimVerdict>& verdicts) {
  return format_json({{"format", "glovebench-verdicts"},
                      {"version", 2},
                      {"required_claim_failed", count_required(verdicts).failed > 0},
                      {"required", required_json(count_required(verdicts))},
                      {"judging", array_of(claim_set().judging, judging_json)},
                      {"verdicts", array_of(verdicts, verdict_json)}});
}

}  // namespace glovebench::reports
