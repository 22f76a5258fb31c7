#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"

namespace glovebench::reports {

/// The values with which a claim holds: an interval, one of whose ends may be infinite.
struct Rule {
  enum class Kind { below, at_most, above, at_least, within };
  Kind kind = Kind::below;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  friend bool operator==(const Rule&, const Rule&) = default;
};
using glovebench::to_string;
/// As claims.json says them.
constexpr auto names_of(Rule::Kind) {
  return std::to_array<std::string_view>({"below", "at_most", "above", "at_least", "within"});
}
bool holds(const Rule& rule, double value);
/// Whether any value from low to high satisfies the rule.
bool meets(const Rule& rule, double low, double high);
/// "below 10", "within 5..15"
std::string to_string(const Rule& rule);

/// Reproduction: the experiment is the paper's. Consistency: it only shows that what the paper cites is plausible.
enum class ClaimKind { reproduction, consistency };
constexpr auto names_of(ClaimKind) {
  return std::to_array<std::string_view>({"reproduction", "consistency"});
}

/// What the paper says, and what a run must have measured for it to hold.
struct ClaimDefinition {
  std::string claim;        ///< one sentence
  std::string source;       ///< section or figure of the paper
  std::string paper_value;  ///< what the paper prints, as text; "" where it prints no number
  std::string measured;     ///< what is measured, on which truth, and what the rule means
  std::string measure;      ///< name of a Measure
  Rule rule;
  ClaimKind kind = ClaimKind::reproduction;
  bool required = false;   ///< a run in which it does not hold has failed
  bool withdrawn = false;  ///< not judged any more, still listed
  std::string if_not;      ///< shown when it does not hold

  friend bool operator==(const ClaimDefinition&, const ClaimDefinition&) = default;
};

/// One change of a claim. The first one writes it.
struct ClaimChange {
  std::string date;                     ///< "2026-11-21"
  std::optional<std::string> commit;    ///< empty for the newest change alone: no commit can name itself
  ClaimDefinition definition;           ///< the definition after this change
  std::vector<std::string> set;         ///< the fields of it that are others than before; none if only the program
                                        ///< that measures it changed
  std::optional<std::string> came_out;  ///< what runs measured with it, and in brackets their commits; empty if no
                                        ///< run was published
  std::string why;

  friend bool operator==(const ClaimChange&, const ClaimChange&) = default;
};

/// A claim: its history, whose newest entry says what it is.
struct Claim {
  std::string id;                    ///< "position-error-source"
  std::vector<ClaimChange> history;  ///< oldest first, at least one

  const ClaimDefinition& definition() const { return history.back().definition; }

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// One change of the way in which all claims are judged.
struct JudgingChange {
  std::string date;
  std::optional<std::string> commit;  ///< as in ClaimChange
  std::string rule;                   ///< how claims are judged from here on, in sentences
  std::string why;

  friend bool operator==(const JudgingChange&, const JudgingChange&) = default;
};

/// Claims in the order of the paper's sections, and how they are and were judged, oldest first.
struct ClaimSet {
  std::vector<Claim> claims;
  std::vector<JudgingChange> judging;

  friend bool operator==(const ClaimSet&, const ClaimSet&) = default;
};

/// A field of a definition by its name in claims.json, as text: "below 10", "true". Throws std::logic_error if
/// there is no such field.
std::string field_text(const ClaimDefinition& definition, std::string_view field);
/// How often a claim became another one than it was when it was first written.
int change_count(const Claim& claim);

/// What this program carries (reports/data/claims.json).
const ClaimSet& claim_set();
const std::vector<Claim>& claims();

/// Strict; throws Error naming `where` and the field.
ClaimSet parse_claims(const std::string& text, const std::string& where);

/// How a later state of the claims tampers with an earlier one, one sentence each; empty if it only adds. No claim
/// and no entry of a history may be gone or changed, but for two gaps that may be filled once: a commit, and what
/// came out.
std::vector<std::string> tampering(const ClaimSet& earlier, const ClaimSet& later);

}  // namespace glovebench::reports
