#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"

namespace glovebench::reports {

/// The values with which a claim holds. One end may be infinite.
struct Rule {
  enum class Kind { below, at_most, above, at_least, within };
  Kind kind = Kind::below;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  friend bool operator==(const Rule&, const Rule&) = default;
};
using glovebench::to_string;
constexpr auto names_of(Rule::Kind) {
  return std::to_array<std::string_view>({"below", "at_most", "above", "at_least", "within"});
}
bool holds(const Rule& rule, double value);
/// True if any value from low to high satisfies the rule.
bool meets(const Rule& rule, double low, double high);
std::string to_string(const Rule& rule);

/// Reproduction: the paper's experiment. Consistency: the paper's number is plausible.
enum class ClaimKind { reproduction, consistency };
constexpr auto names_of(ClaimKind) { return std::to_array<std::string_view>({"reproduction", "consistency"}); }

/// What the paper says, and what a run must measure.
struct ClaimDefinition {
  std::string claim;
  std::string quote;        ///< the paper's words
  std::string source;       ///< section or figure
  std::string paper_value;  ///< as printed; "": no number
  std::string measured;     ///< what, on which truth; the rule's meaning
  std::string measure;      ///< of a Measure
  Rule rule;
  bool ours = false;  ///< the paper states neither the rule nor its bound
  ClaimKind kind = ClaimKind::reproduction;
  bool required = false;   ///< the run fails if it does not hold
  bool withdrawn = false;  ///< listed, not judged
  std::string if_not;      ///< shown if it does not hold

  friend bool operator==(const ClaimDefinition&, const ClaimDefinition&) = default;
};

/// The first change creates the claim.
struct ClaimChange {
  std::string date;
  std::optional<std::string> commit;  ///< empty only for the newest change
  ClaimDefinition definition;
  std::vector<std::string> set;         ///< changed fields; none: only the program changed
  std::optional<std::string> came_out;  ///< published measurements with commits
  std::string why;

  friend bool operator==(const ClaimChange&, const ClaimChange&) = default;
};

struct Claim {
  std::string id;                    ///< "position-error-source"
  std::vector<ClaimChange> history;  ///< oldest first, not empty

  const ClaimDefinition& definition() const { return history.back().definition; }

  friend bool operator==(const Claim&, const Claim&) = default;
};

struct JudgingChange {
  std::string date;
  std::optional<std::string> commit;  ///< as in ClaimChange
  std::string rule;                   ///< valid from `date` on
  std::string why;

  friend bool operator==(const JudgingChange&, const JudgingChange&) = default;
};

/// Claims in the paper's order; `judging` oldest first.
struct ClaimSet {
  std::vector<Claim> claims;
  std::vector<JudgingChange> judging;
};

/// A field of claims.json, but a rule in words: "below 10".
/// Throws: std::logic_error for another field.
nlohmann::ordered_json field_json(const ClaimDefinition& definition, std::string_view field);
/// Number of changes after the first, not counting a quote or mark alone.
int change_count(const Claim& claim);

/// reports/data/claims.json.
const ClaimSet& claim_set();
const std::vector<Claim>& claims();

/// Throws: Error.
ClaimSet parse_claims(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
