#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::reports {

/// The values with which a claim holds: an interval, one of whose ends may be infinite.
struct Rule {
  enum class Kind { below, at_most, above, at_least, within };
  Kind kind = Kind::below;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  friend bool operator==(const Rule&, const Rule&) = default;
};
bool holds(const Rule& rule, double value);
/// Whether any value from low to high satisfies the rule.
bool meets(const Rule& rule, double low, double high);
/// "below 10", "within 5..15"
std::string to_string(const Rule& rule);

/// Reproduction: the experiment is the paper's. Consistency: it only shows that what the paper cites is plausible.
enum class ClaimKind { reproduction, consistency };
std::string_view to_string(ClaimKind kind);

/// What the paper says, and what a run must have measured for it to hold. Rules are not fitted to results.
struct Claim {
  std::string id;           ///< "position-error-source"
  std::string claim;        ///< one sentence
  std::string source;       ///< section or figure of the paper
  std::string paper_value;  ///< what the paper prints, as text; "" where it prints no number
  std::string measured;     ///< what is measured, on which truth, and what the rule means
  std::string measure;      ///< name of a Measure
  Rule rule;
  ClaimKind kind = ClaimKind::reproduction;
  bool required = false;  ///< a run in which it does not hold has failed
  std::string if_not;     ///< shown when it does not hold

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// The claims that this program carries (reports/data/claims.json), in the order of the paper's sections.
const std::vector<Claim>& claims();
/// Strict; throws Error naming `where` and the field.
std::vector<Claim> parse_claims(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
