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

std::string field_text(const ClaimDefinition& definition, std::string_view field) {
  const ClaimDefinition& d = definition;
  if (field == "claim") return d.claim;
  if (field == "quote") return d.quote;
  if (field == "source") return d.source;
  if (field == "paper_value") return d.paper_value;
  if (field == "measured") return d.measured;
  if (field == "measure") return d.measure;
  if (field == "rule") return to_string(d.rule);
  if (field == "ours") return fmt::to_string(d.ours);
  if (field == "kind") return std::string(to_string(d.kind));
  if (field == "required") return fmt::to_string(d.required);
  if (field == "withdrawn") return fmt::to_string(d.withdrawn);
  check(field == "if_not", "a field of a claim");
  return d.if_not;
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

namespace {

bool is_filled_once(const std::optional<std::string>& earlier, const std::optional<std::string>& later) {
  return !earlier || earlier == later;
}

bool is_kept(const ClaimChange& earlier, const ClaimChange& later) {
  ClaimChange filled = earlier;
  filled.commit = later.commit;
  filled.came_out = later.came_out;
  return filled == later && is_filled_once(earlier.commit, later.commit) &&
         is_filled_once(earlier.came_out, later.came_out);
}

bool is_kept(const JudgingChange& earlier, const JudgingChange& later) {
  JudgingChange filled = earlier;
  filled.commit = later.commit;
  return filled == later && is_filled_once(earlier.commit, later.commit);
}

template <typename Change>
void compare(const std::string& whose, const std::vector<Change>& earlier, const std::vector<Change>& later,
             std::vector<std::string>& found) {
  for (size_t i = 0; i < earlier.size(); ++i) {
    if (i >= later.size())
      found.push_back(fmt::format("{}: entry {} of its history is gone", whose, i + 1));
    else if (!is_kept(earlier[i], later[i]))
      found.push_back(fmt::format("{}: entry {} of its history is another one", whose, i + 1));
  }
}

}  // namespace

std::vector<std::string> tampering(const ClaimSet& earlier, const ClaimSet& later) {
  std::vector<std::string> found;
  compare("judging", earlier.judging, later.judging, found);
  for (const Claim& claim : earlier.claims) {
    const auto now = std::ranges::find(later.claims, claim.id, &Claim::id);
    if (now == later.claims.end())
      found.push_back(fmt::format("{}: the claim is gone", claim.id));
    else
      compare(claim.id, claim.history, now->history, found);
  }
  return found;
}

}  // namespace glovebench::reports
