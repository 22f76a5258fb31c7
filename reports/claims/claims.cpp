#include "reports/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/check.h"
#include "core/base/parse_json.h"
#include "reports/embedded.h"
#include "reports/json_reader.h"

namespace glovebench::reports {
namespace {

/// Rules are about millimetres, degrees, counts and ratios: a larger bound is a slip of the pen.
constexpr double kLargestBound = 1e6;

constexpr std::array<std::pair<std::string_view, Rule::Kind>, 5> kRules = {{{"below", Rule::Kind::below},
                                                                            {"at_most", Rule::Kind::at_most},
                                                                            {"above", Rule::Kind::above},
                                                                            {"at_least", Rule::Kind::at_least},
                                                                            {"within", Rule::Kind::within}}};

Rule::Kind read_rule_kind(const JsonReader& json, const std::string& name) {
  for (const auto& [known, kind] : kRules)
    if (known == name) return kind;
  json.fail("one of below, at_most, above, at_least, within");
}

Rule read_rule(const JsonReader& json) {
  const auto members = json.members();
  if (members.size() != 1) json.fail("an object with one rule");
  const auto& [name, bound] = members.front();
  Rule rule;
  rule.kind = read_rule_kind(json, name);
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

ClaimKind read_kind(const JsonReader& json) {
  const std::string name = json.text();
  for (const ClaimKind kind : {ClaimKind::reproduction, ClaimKind::consistency})
    if (to_string(kind) == name) return kind;
  json.fail("reproduction or consistency");
}

/// One line that is not empty.
std::string read_sentence(const JsonReader& json) {
  const std::string text = json.text();
  if (text.empty() || text.find_first_of("\r\n") != std::string::npos) json.fail("a line of text");
  return text;
}

std::string read_id(const JsonReader& json, const std::vector<Claim>& before) {
  const std::string id = json.text();
  const bool is_id = !id.empty() && id.size() <= 40 && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!is_id) json.fail("lower-case letters, digits and hyphens, 40 at most");
  if (std::ranges::find(before, id, &Claim::id) != before.end()) json.fail("an id that has not been before");
  return id;
}

Claim read_claim(const JsonReader& json, const std::vector<Claim>& before) {
  json.expect_keys(
      {"id", "claim", "source", "paper_value", "measured", "measure", "rule", "kind", "required", "if_not"});
  Claim claim;
  claim.id = read_id(json["id"], before);
  claim.claim = read_sentence(json["claim"]);
  claim.source = read_sentence(json["source"]);
  claim.paper_value = json["paper_value"].text();
  claim.measured = read_sentence(json["measured"]);
  claim.measure = read_sentence(json["measure"]);
  claim.rule = read_rule(json["rule"]);
  claim.kind = read_kind(json["kind"]);
  claim.required = json["required"].boolean();
  claim.if_not = read_sentence(json["if_not"]);
  return claim;
}

}  // namespace

bool holds(const Rule& rule, double value) {
  return meets(rule, value, value);
}

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

std::string_view to_string(ClaimKind kind) {
  return kind == ClaimKind::reproduction ? "reproduction" : "consistency";
}

const std::vector<Claim>& claims() {
  static const std::vector<Claim> claims = parse_claims(embedded_claims(), "claims.json");
  return claims;
}

std::vector<Claim> parse_claims(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonReader json(document, where);
  json["format"].expect_text("glovebench-claims");
  json["version"].integer(1, 1);
  json.expect_keys({"format", "version", "claims"});
  std::vector<Claim> claims;
  for (const JsonReader& item : json["claims"].items()) claims.push_back(read_claim(item, claims));
  return claims;
}

}  // namespace glovebench::reports
