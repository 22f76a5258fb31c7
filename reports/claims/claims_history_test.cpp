// Histories of the claims are complete, true and never rewritten.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "ci/build_paths.h"
#include "core/test_folder.h"
#include "reports/claims/claims.h"
#include "reports/embedded.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

json& find_in(json& document, const std::string& id) {
  for (json& claim : document["claims"])
    if (claim["id"] == id) return claim;
  throw std::logic_error("no claim " + id);
}

ClaimSet changed_set(const std::function<void(json&)>& change) {
  json document = json::parse(embedded_claims());
  change(document);
  return parse_claims(document.dump(), "claims.json");
}

bool is_kept(ClaimChange earlier, const ClaimChange& later) {
  if (!earlier.commit) earlier.commit = later.commit;
  if (!earlier.came_out) earlier.came_out = later.came_out;
  return earlier == later;
}
bool is_kept(JudgingChange earlier, const JudgingChange& later) {
  if (!earlier.commit) earlier.commit = later.commit;
  return earlier == later;
}

template <typename Change>
void compare(const std::string& whose, const std::vector<Change>& earlier, const std::vector<Change>& later,
             std::vector<std::string>& found) {
  for (size_t i = 0; i < earlier.size(); ++i)
    if (i >= later.size())
      found.push_back(fmt::format("{}: entry {} of its history is gone", whose, i + 1));
    else if (!is_kept(earlier[i], later[i]))
      found.push_back(fmt::format("{}: entry {} of its history is another one", whose, i + 1));
}

/// A sentence per entry of `earlier` that `later` changes. It may add entries, and fill an empty commit or
/// `came_out`.
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

std::string history_error(const std::function<void(json&)>& change) {
  return thrown_by([&] { changed_set(change); });
}

TEST(ClaimsHistory, AChangeThatIsToldIsTaken) {
  const ClaimSet set = changed_set([](json& j) {
    json& claim = find_in(j, "position-below-1-cm-source");
    json& commit = claim["history"].back()["commit"];
    if (commit.is_null()) commit = "0123456";  // only the newest may lack one
    claim["history"].push_back({{"date", "2027-01-01"},
                                {"commit", nullptr},
                                {"set", {{"rule", {{"below", 11}}}}},
                                {"came_out", nullptr},
                                {"why", "An example."}});
  });
  const Claim& claim = set.claims[1];
  EXPECT_EQ(claim.definition().rule.high, 11);
  EXPECT_EQ(claim.history.front().definition.rule.high, 10);
  EXPECT_THAT(claim.history.back().set, ElementsAre("rule"));
  EXPECT_EQ(change_count(claim), 1);
  EXPECT_THAT(tampering(claim_set(), set), IsEmpty());
  EXPECT_THAT(tampering(set, claim_set()),
              testing::Contains("position-below-1-cm-source: entry 3 of its history is gone"));
}

TEST(ClaimsHistory, ErrorsInEntries) {
  const auto error_of_entry = [](const std::function<void(json&)>& change) {
    return history_error([&](json& j) { change(find_in(j, "15-hz-plain")["history"]); });
  };
  EXPECT_THAT(error_of_entry([](json& h) { h = json::array(); }), HasSubstr("at least the entry that writes"));
  EXPECT_THAT(error_of_entry([](json& h) { h[0]["set"].erase("rule"); }),
              HasSubstr("history[0].set.rule: found nothing"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["set"]["mood"] = 1; }), HasSubstr("which mood is not"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["set"]["kind"] = "consistency"; }),
              HasSubstr("history[1].set.kind: found \"consistency\", expected another value than before"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["date"] = "2026-11-20"; }), HasSubstr("2026-11-22 or later"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["date"] = "yesterday"; }), HasSubstr("a date, YYYY-MM-DD"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["commit"] = nullptr; }), HasSubstr("7 to 40 hexadecimal digits"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["commit"] = "HEAD~1"; }), HasSubstr("7 to 40 hexadecimal digits"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1]["why"] = ""; }), HasSubstr("a line of text"));
  EXPECT_THAT(error_of_entry([](json& h) { h[1].erase("came_out"); }),
              HasSubstr("history[1].came_out: found nothing"));
}

TEST(ClaimsHistory, WhatIsGoneOrRewrittenIsTampering) {
  const auto found = [](const std::function<void(json&)>& change) {
    return tampering(claim_set(), changed_set(change));
  };
  const auto remove = [](json& j, const std::string& id) {
    for (size_t i = 0; i < j["claims"].size(); ++i)
      if (j["claims"][i]["id"] == id) j["claims"].erase(i);
  };
  EXPECT_THAT(found([](json&) {}), IsEmpty());
  EXPECT_THAT(found([&](json& j) { remove(j, "15-hz-plain"); }), ElementsAre("15-hz-plain: the claim is gone"));
  EXPECT_THAT(found([](json& j) { find_in(j, "15-hz-plain")["history"][0]["came_out"] = "16 ms: consistent"; }),
              ElementsAre("15-hz-plain: entry 1 of its history is another one"));
  EXPECT_THAT(found([](json& j) { find_in(j, "15-hz")["history"][1]["why"] = "Nothing."; }),
              ElementsAre("15-hz: entry 2 of its history is another one"));
  EXPECT_THAT(found([](json& j) {
                find_in(j, "large-database-worst")["history"][0]["set"]["rule"] = {{"at_least", 3}};
              }),
              testing::SizeIs(4));
  EXPECT_THAT(found([](json& j) { j["judging"].erase(1); }), testing::Contains(HasSubstr("judging: entry 2")));
}

TEST(ClaimsHistory, GapsAreFilledOnce) {
  const auto fill = [](const std::string& field, const std::string& text) {
    return changed_set([&](json& j) { find_in(j, "15-hz-plain")["history"].back()[field] = text; });
  };
  for (const std::string field : {"commit", "came_out"}) {
    const ClaimSet gap =
        changed_set([&](json& j) { find_in(j, "15-hz-plain")["history"].back()[field] = nullptr; });
    const ClaimSet once = fill(field, "0123456789"), twice = fill(field, "0123456780");
    EXPECT_THAT(tampering(gap, once), IsEmpty()) << field;
    EXPECT_THAT(tampering(once, twice), testing::SizeIs(1)) << field;
    EXPECT_THAT(tampering(once, gap), testing::SizeIs(1)) << field;
  }
}

TEST(ClaimsHistory, TheClaimThatWasRemovedIsBackWithItsOutcome) {
  const auto claim = std::ranges::find(claims(), "15-hz-plain", &Claim::id);
  ASSERT_NE(claim, claims().end());
  EXPECT_FALSE(claim->definition().withdrawn);
  EXPECT_EQ(claim->definition().measure, "frame.p95_ms_20_postures_plain");
  ASSERT_GE(claim->history.size(), 3U);
  EXPECT_EQ(claim->history[0].came_out, "160 ms: not consistent (7bbb283)");
  EXPECT_TRUE(claim->history[1].definition.withdrawn);
}

TEST(ClaimsHistory, TheCalibrationOfFigure5IsNoClaim) {
  const auto claim = std::ranges::find(claims(), "figure-5-posture", &Claim::id);
  ASSERT_NE(claim, claims().end());
  EXPECT_TRUE(claim->definition().withdrawn);
  ASSERT_GE(claim->history.size(), 3U);
  EXPECT_THAT(claim->history[2].set, ElementsAre("withdrawn"));
  EXPECT_THAT(claim->history[2].why, HasSubstr("calibration, not evidence"));
}

TEST(ClaimsHistory, AQuoteOrMarkAloneIsNoChange) {
  Claim claim = claims().front();
  claim.history.resize(1);
  ClaimChange& change = claim.history.emplace_back(claim.history.front());
  change.set = {"quote", "ours"};
  EXPECT_EQ(change_count(claim), 0);
  change.set = {"quote", "rule"};
  EXPECT_EQ(change_count(claim), 1);
}

/// Output of a program; empty if it failed.
std::optional<std::string> output_of(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string text;
  std::array<char, 4096> part;
  for (size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
  const int status = ::pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return text;
}
std::optional<std::string> git(const std::string& folder, const std::string& arguments) {
  return output_of(fmt::format("git -C '{}' {}", folder, arguments));
}
/// Throws std::runtime_error with advice if git fails.
std::string git_or_throw(const std::string& folder, const std::string& arguments, const std::string& advice) {
  if (const auto text = git(folder, arguments)) return *text;
  throw std::runtime_error(fmt::format("{}: git {} failed: {}", folder, arguments, advice));
}

/// All committed states of claims.json, oldest first. Empty without a repository or git. Throws std::runtime_error
/// if the repository cannot be read back to its first commit.
std::vector<std::pair<std::string, json>> committed_states(const std::string& folder) {
  if (!std::filesystem::exists(folder + "/.git") || !output_of("git --version")) return {};
  const std::string file = "reports/data/claims.json", damaged = "found a damaged repository, expected a whole one";
  const std::string top = git_or_throw(
      folder, "rev-parse --show-cdup",
      fmt::format("if the folder is another user's: git config --global --add safe.directory '{}'", folder));
  if (top != "\n") throw std::runtime_error(folder + "/.git: found no repository, expected one");
  if (git_or_throw(folder, "rev-parse --is-shallow-repository", damaged) != "false\n")
    throw std::runtime_error(folder + ": found a shallow repository, expected all commits: git fetch --unshallow");
  if (git_or_throw(folder, "rev-list --max-count=1 --all", damaged).empty()) return {};
  std::vector<std::pair<std::string, json>> states;
  std::istringstream commits(git_or_throw(folder, "log --reverse --topo-order --format=%H -- " + file, damaged));
  for (std::string commit; std::getline(commits, commit);)
    states.emplace_back(commit,
                        json::parse(git_or_throw(folder, fmt::format("show {}:{}", commit, file), damaged)));
  return states;
}

/// A claim's definition in version 1 or 2, where it was beside the history (version 1 had none).
ClaimDefinition definition_of(const json& claim) {
  json set = claim;
  set.erase("id");
  set.erase("history");
  if (!set.contains("withdrawn")) set["withdrawn"] = false;
  const json whole = {
      {"id", claim["id"]},
      {"history",
       {{{"date", "2026-01-01"}, {"commit", nullptr}, {"set", set}, {"came_out", nullptr}, {"why", "."}}}}};
  const json document = {{"format", "glovebench-claims"},
                         {"version", 3},
                         {"judging", {{{"date", "2026-01-01"}, {"commit", nullptr}, {"rule", "."}, {"why", "."}}}},
                         {"claims", {whole}}};
  return parse_claims(document.dump(), "an old claim").claims[0].definition();
}

/// Follows the histories and reports differences from the commits.
class Follower {
 public:
  void follow(const std::string& commit, const json& document) {
    std::map<std::string, ClaimDefinition> then;
    for (const json& claim : document["claims"]) then.emplace(claim["id"], definition_of(claim));
    for (const auto& [id, definition] : then) expect_entry(commit, id, definition);
    for (const Claim& claim : claims()) {
      if (!now_.contains(claim.id) || then.contains(claim.id) || now_.at(claim.id).withdrawn) continue;
      ClaimDefinition gone = now_.at(claim.id);
      gone.withdrawn = true;
      expect_entry(commit, claim.id, gone);
    }
  }

 private:
  void expect_entry(const std::string& commit, const std::string& id, const ClaimDefinition& definition) {
    if (now_.contains(id) && now_.at(id) == definition) return;
    now_[id] = definition;
    const auto claim = std::ranges::find(claims(), id, &Claim::id);
    ASSERT_NE(claim, claims().end()) << id << " was a claim at " << commit;
    const auto is_it = [&](const ClaimChange& change) {
      return change.commit && commit.starts_with(*change.commit) && change.definition == definition;
    };
    EXPECT_TRUE(std::ranges::any_of(claim->history, is_it)) << id << " became another claim at " << commit;
  }

  std::map<std::string, ClaimDefinition> now_;
};

/// Reads version 2, where each claim repeated its newest definition beside the history.
ClaimSet set_of_version_2(json document, const std::string& commit) {
  document["version"] = 3;
  std::vector<ClaimDefinition> definitions;
  for (json& claim : document["claims"]) {
    definitions.push_back(definition_of(claim));
    claim = {{"id", claim["id"]}, {"history", claim["history"]}};
  }
  const ClaimSet set = parse_claims(document.dump(), commit);
  for (size_t c = 0; c < definitions.size(); ++c)
    EXPECT_EQ(definitions[c], set.claims[c].definition()) << set.claims[c].id << " at " << commit;
  return set;
}

TEST(ClaimsHistory, NothingThatWasCommittedIsGoneOrAnother) {
  const auto states = committed_states(build_paths::source(""));
  if (states.empty()) GTEST_SKIP() << "the sources have no repository, or git is not installed";
  Follower follower;
  for (const auto& [commit, document] : states) {
    if (document["version"] == 1) {
      follower.follow(commit, document);
      continue;
    }
    const ClaimSet then =
        document["version"] == 2 ? set_of_version_2(document, commit) : parse_claims(document.dump(), commit);
    EXPECT_THAT(tampering(then, claim_set()), IsEmpty()) << "since " << commit;
  }
}

std::string error_of_states(const std::string& folder) {
  return thrown_by<std::runtime_error>([&] { committed_states(folder); });
}

TEST(ClaimsHistory, ARepositoryThatCannotBeReadIsAnErrorAndNoneIsNot) {
  if (!output_of("git --version")) GTEST_SKIP() << "git is not installed";
  const TestFolder folder;
  EXPECT_THAT(committed_states(folder.path()), IsEmpty());
  std::filesystem::create_directory(folder / ".git");
  EXPECT_NE(error_of_states(folder.path()), "") << "no repository lies in .git";
  const std::string whole = folder / "whole", part = folder / "part";
  const std::string commit =
      "-c user.name=Test -c user.email=test@localhost -c commit.gpgsign=false commit --quiet --allow-empty";
  ASSERT_TRUE(output_of("git init --quiet '" + whole + "'"));
  EXPECT_THAT(committed_states(whole), IsEmpty()) << "no commit";
  ASSERT_TRUE(git(whole, commit + " --message=First") && git(whole, commit + " --message=Second"));
  EXPECT_THAT(committed_states(whole), IsEmpty()) << "no claims";
  ASSERT_TRUE(output_of("git clone --quiet --depth=1 'file://" + whole + "' '" + part + "'"));
  EXPECT_THAT(error_of_states(part), HasSubstr("git fetch --unshallow"));
}

}  // namespace
}  // namespace glovebench::reports
