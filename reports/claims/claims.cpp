#include "reports/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "reports/embedded.h"

namespace glovebench::reports {
namespace {

/// Rules are about millimeters, degrees, counts and ratios; a larger bound is a typing error.
constexpr double kLargestBound = 1e6;

Rule read_rule(const JsonCursor& json) {
  const auto members = json.members();
  if (members.size() != 1) json.fail("an object with one rule");
  const auto& [name, bound] = members.front();
  const std::optional<Rule::Kind> kind = from_name<Rule::Kind>(name);
  if (!kind) json.fail(known_names<Rule::Kind>());
  Rule rule{.kind = *kind};
  if (rule.kind == Rule::Kind::within) {
    const JsonItems bounds = bound.items();
    if (bounds.size() != 2) bound.fail("the lower and the upper bound");
    rule.low = bounds[0].number(-kLargestBound, kLargestBound);
    rule.high = bounds[1].number(rule.low, kLargestBound);
  } else {
    const bool is_upper = rule.kind == Rule::Kind::below || rule.kind == Rule::Kind::at_most;
    (is_upper ? rule.high : rule.low) = bound.number(-kLargestBound, kLargestBound);
  }
  return rule;
}

/// One line that is not empty.
std::string read_sentence(const JsonCursor& json) {
  const std::string text = json.text();
  if (text.empty() || text.find_first_of("\r\n") != std::string::npos) json.fail("a line of text");
  return text;
}

bool consists_of(const std::string& text, size_t min, size_t max, std::string_view letters) {
  return text.size() >= min && text.size() <= max && text.find_first_not_of(letters) == std::string::npos;
}

std::string read_id(const JsonCursor& json, const std::vector<Claim>& before) {
  const std::string id = json.text();
  if (!consists_of(id, 1, 40, "abcdefghijklmnopqrstuvwxyz0123456789-"))
    json.fail("lower-case letters, digits and hyphens, 40 at most");
  if (std::ranges::find(before, id, &Claim::id) != before.end()) json.fail("each id once");
  return id;
}

struct Field {
  std::string_view name;
  void (*read)(ClaimDefinition& definition, const JsonCursor& json);
  nlohmann::ordered_json (*write)(const ClaimDefinition& definition);
};

/// `read_value`: of a JsonCursor.
template <auto member, auto read_value>
constexpr Field field(std::string_view name) {
  return {name,
          [](ClaimDefinition& definition, const JsonCursor& json) {
            definition.*member = std::invoke(read_value, json);
          },
          [](const ClaimDefinition& definition) -> nlohmann::ordered_json {
            if constexpr (requires { to_string(definition.*member); })
              return to_string(definition.*member);
            else
              return definition.*member;
          }};
}

/// The first ten are in a claim's first entry. The others were added later and have defaults.
constexpr size_t kFirstFields = 10;
constexpr std::array<Field, 12> kFields = {field<&ClaimDefinition::claim, read_sentence>("claim"),
                                           field<&ClaimDefinition::source, read_sentence>("source"),
                                           field<&ClaimDefinition::paper_value, &JsonCursor::text>("paper_value"),
                                           field<&ClaimDefinition::measured, read_sentence>("measured"),
                                           field<&ClaimDefinition::measure, read_sentence>("measure"),
                                           field<&ClaimDefinition::rule, read_rule>("rule"),
                                           field<&ClaimDefinition::kind, &JsonCursor::one_of<ClaimKind>>("kind"),
                                           field<&ClaimDefinition::required, &JsonCursor::boolean>("required"),
                                           field<&ClaimDefinition::withdrawn, &JsonCursor::boolean>("withdrawn"),
                                           field<&ClaimDefinition::if_not, read_sentence>("if_not"),
                                           field<&ClaimDefinition::quote, read_sentence>("quote"),
                                           field<&ClaimDefinition::ours, &JsonCursor::boolean>("ours")};

std::string read_date(const JsonCursor& json, const std::string& before) {
  const std::string date = json.text();
  const bool is_date = date.size() == 10 && date[4] == '-' && date[7] == '-' &&
                       consists_of(date.substr(0, 4) + date.substr(5, 2) + date.substr(8), 8, 8, "0123456789");
  if (!is_date) json.fail("a date, YYYY-MM-DD");
  if (date < before) json.fail(fmt::format("{} or later, as the entry before", before));
  return date;
}

std::optional<std::string> read_commit(const JsonCursor& json, bool is_newest) {
  if (json.is_null() && is_newest) return std::nullopt;
  const bool is_commit = json.is_text() && consists_of(json.text(), 7, 40, "0123456789abcdef");
  if (!is_commit) json.fail("a commit, 7 to 40 hexadecimal digits, or in the newest entry null");
  return json.text();
}

/// Sets the fields that a change names: at least the first ones in the first change, only different ones later.
void apply(const JsonCursor& set, bool is_first, ClaimChange& change) {
  for (const auto& [name, value] : set.members()) {
    const ClaimDefinition before = change.definition;
    const auto known = std::ranges::find(kFields, name, &Field::name);
    if (known == kFields.end()) set.fail(fmt::format("fields of a claim, which {} is not", name));
    known->read(change.definition, value);
    if (!is_first && change.definition == before) value.fail("another value than before");
    change.set.push_back(name);
  }
  if (is_first)
    for (size_t f = 0; f < kFirstFields; ++f) set[kFields[f].name];
}

ClaimChange read_change(const JsonCursor& json, const ClaimChange* before, bool is_newest) {
  json.expect_keys({"date", "commit", "set", "came_out", "why"});
  ClaimChange change;
  if (before) change.definition = before->definition;
  change.date = read_date(json["date"], before ? before->date : "");
  change.commit = read_commit(json["commit"], is_newest);
  apply(json["set"], before == nullptr, change);
  if (!json["came_out"].is_null()) change.came_out = read_sentence(json["came_out"]);
  change.why = read_sentence(json["why"]);
  return change;
}

std::vector<ClaimChange> read_history(const JsonCursor& json) {
  std::vector<ClaimChange> history;
  const JsonItems items = json.items();
  if (items.size() == 0) json.fail("at least the entry that writes the claim");
  for (const JsonCursor& item : items)
    history.push_back(
        read_change(item, history.empty() ? nullptr : &history.back(), history.size() + 1 == items.size()));
  return history;
}

Claim read_claim(const JsonCursor& json, const std::vector<Claim>& before) {
  json.expect_keys({"id", "history"});
  return {read_id(json["id"], before), read_history(json["history"])};
}

std::vector<JudgingChange> read_judging(const JsonCursor& json) {
  std::vector<JudgingChange> judging;
  const JsonItems items = json.items();
  if (items.size() == 0) json.fail("at least one entry");
  for (const JsonCursor& item : items) {
    item.expect_keys({"date", "commit", "rule", "why"});
    judging.push_back({read_date(item["date"], judging.empty() ? "" : judging.back().date),
                       read_commit(item["commit"], judging.size() + 1 == items.size()), read_sentence(item["rule"]),
                       read_sentence(item["why"])});
  }
  return judging;
}

}  // namespace

bool holds(const Rule& rule, double value) { return meets(rule, value, value); }

bool meets(const Rule& rule, double low, double high) {
  check(low <= high, "an interval begins before it ends");
  if (rule.kind == Rule::Kind::below) return low < rule.high;
  if (rule.kind == Rule::Kind::above) return high > rule.low;
  return low <= rule.high && high >= rule.low;
}

std::string to_string(const Rule& rule) {
  switch (rule.kind) {
    case Rule::Kind::below:
      return fmt::format("below {}", rule.high);
    case Rule::Kind::at_most:
      return fmt::format("at most {}", rule.high);
    case Rule::Kind::above:
      return fmt::format("above {}", rule.low);
    case Rule::Kind::at_least:
      return fmt::format("at least {}", rule.low);
    case Rule::Kind::within:
      break;
  }
  return fmt::format("within {}..{}", rule.low, rule.high);
}

int change_count(const Claim& claim) {
  const auto is_change = [](const ClaimChange& change) {
    return std::ranges::any_of(change.set,
                               [](const std::string& field) { return field != "quote" && field != "ours"; });
  };
  return static_cast<int>(std::ranges::count_if(claim.history, is_change)) - 1;
}

const ClaimSet& claim_set() {
  static const ClaimSet set = parse_claims(embedded_claims(), "claims.json");
  return set;
}

const std::vector<Claim>& claims() { return claim_set().claims; }

nlohmann::ordered_json field_json(const ClaimDefinition& definition, std::string_view field) {
  const auto known = std::ranges::find(kFields, field, &Field::name);
  check(known != kFields.end(), "a field of a claim");
  return known->write(definition);
}

ClaimSet parse_claims(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format("glovebench-claims", 3);
  json.expect_keys({"format", "version", "judging", "claims"});
  ClaimSet set;
  set.judging = read_judging(json["judging"]);
  for (const JsonCursor& item : json["claims"].items()) set.claims.push_back(read_claim(item, set.claims));
  return set;
}

}  // namespace glovebench::reports
