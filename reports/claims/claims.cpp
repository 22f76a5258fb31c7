#include "reports/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "reports/embedded.h"

namespace glovebench::reports {

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

}  // namespace glovebench::reports
