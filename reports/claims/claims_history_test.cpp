// The claims' histories: complete, true, and never rewritten.

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
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/test_folder.h"
#include "reports/claims/claims.h"
#include "reports/embedded.h"

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
std::string history_error(const std::function<void(json&)>& change) {
  try {
    changed_set(change);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ClaimsHistory, AnotherFieldThanThatOfTheNewestEntryIsAnError) {
  const std::map<std::string, json> others = {{"claim", "Another."},
                                              {"source", "section I"},
                                              {"paper_value", "5"},
                                              {"measured", "Another way."},
                                              {"measure", "figure5.position_error_mm"},
                                              {"rule", {{"below", 11}}},
                                              {"kind", "consistency"},
                                              {"required", false},
                                              {"withdrawn", true},
                                              {"if_not", "Pity."}};
  for (const auto& [field, other] : others) {
    const std::string error =
        history_error([&](json& j) { find_in(j, "position-below-1-cm-source")[field] = other; });
    EXPECT_THAT(error, HasSubstr("claims[1]." + field + ": found ")) << error;
    EXPECT_THAT(error, HasSubstr("expected that of the newest entry of its history")) << error;
  }
}

TEST(ClaimsHistory, AChangeThatIsToldIsTaken) {
  const ClaimSet set = changed_set([](json& j) {
    json& claim = find_in(j, "position-below-1-cm-source");
    claim["rule"] = {{"below", 11}};
    claim["history"].push_back({{"date", "2027-01-01"},
                                {"commit", nullptr},
                                {"set", {{"rule", {{"below", 11}}}}},
                                {"came_out", nullptr},
                                {"why", "An example."}});
  });
  const Claim& claim = set.claims[1];
  EXPECT_EQ(claim.rule.high, 11);
  EXPECT_EQ(claim.history.front().definition.rule.high, 10);
  EXPECT_THAT(claim.history.back().set, ElementsAre("rule"));
  EXPECT_EQ(change_count(claim), 1);
  EXPECT_THAT(tampering(claim_set(), set), IsEmpty());
  EXPECT_THAT(tampering(set, claim_set()),
              ElementsAre("position-below-1-cm-source: entry 2 of its history is gone"));
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
                json& claim = find_in(j, "large-database-worst");  // rule and history together
                claim["rule"] = {{"at_least", 3}};
                claim["history"][0]["set"]["rule"] = {{"at_least", 3}};
              }),
              testing::SizeIs(3));
  EXPECT_THAT(found([](json& j) { j["judging"].erase(1); }), testing::Contains(HasSubstr("judging: entry 2")));
}

TEST(ClaimsHistory, GapsAreFilledOnce) {
  const auto fill = [](const std::string& field, const std::string& text) {
    return changed_set([&](json& j) { find_in(j, "15-hz-plain")["history"][2][field] = text; });
  };
  for (const std::string field : {"commit", "came_out"}) {
    const ClaimSet gap = changed_set([&](json& j) { find_in(j, "15-hz-plain")["history"][2][field] = nullptr; });
    const ClaimSet once = fill(field, "0123456789"), twice = fill(field, "0123456780");
    EXPECT_THAT(tampering(gap, once), IsEmpty()) << field;
    EXPECT_THAT(tampering(once, twice), testing::SizeIs(1)) << field;
    EXPECT_THAT(tampering(once, gap), testing::SizeIs(1)) << field;
  }
}

TEST(ClaimsHistory, TheClaimThatWasRemovedIsBackWithItsOutcome) {
  const auto claim = std::ranges::find(claims(), "15-hz-plain", &Claim::id);
  ASSERT_NE(claim, claims().end());
  EXPECT_FALSE(claim->withdrawn);
  EXPECT_EQ(claim->measure, "frame.p95_ms_20_postures_plain");
  ASSERT_GE(claim->history.size(), 3U);
  EXPECT_EQ(claim->history[0].came_out, "160 ms: not consistent (7bbb283)");
  EXPECT_TRUE(claim->history[1].definition.withdrawn);
}

/// What a history says, in short.
std::string fingerprint(const Claim& claim) {
  std::string text;
  for (const ClaimChange& change : claim.history) {
    text += fmt::format("{}\n{}\n{}\n{}\n{}\n", change.date, change.commit.value_or(""), fmt::join(change.set, ","),
                        change.came_out.value_or(""), change.why);
    for (const std::string& field : change.set) text += field_text(change.definition, field) + "\n";
  }
  return fmt::format("{} {} {}", claim.id, claim.history.size(), hash_text(text).substr(0, 12));
}

/// Fingerprints of every claim since the first. A line may change only with a new entry; none is removed.
const std::vector<std::string> kFingerprints = {"judging 5 601ce7ed9eb0",
                                                "position-below-1-cm-recorded 1 a0a6098a86e6",
                                                "position-below-1-cm-source 1 6a74b4fffbb2",
                                                "errors-grow-with-the-database 3 52eb61f760e2",
                                                "specific-database-best 3 52da28463a9e",
                                                "large-database-worst 3 a459dd15916b",
                                                "figure-5-position 2 8dfe9b30e59f",
                                                "figure-5-posture 2 4afe8f91fe1d",
                                                "figure-5-rotation 2 96f6e338bdbf",
                                                "figure-6-position 2 d095ef6e0026",
                                                "figure-6-posture 2 fc1a0a458e06",
                                                "figure-6-rotation 2 328d36d631a3",
                                                "posture-lags 2 8e944ff86648",
                                                "lag-is-the-filter 1 e5cd6b19ff28",
                                                "small-images-are-cheaper 3 6342e17de99c",
                                                "small-images-rank-worse 2 3ce8a9885d34",
                                                "cascade-saves-time 5 ec9dce09b998",
                                                "cascade-keeps-accuracy 1 994fabba397c",
                                                "8x8-alone-fastest 5 868257de616d",
                                                "8x8-alone-least-accurate 1 cf88e1cbd2ef",
                                                "runtime-falls-to-the-look-up 7 87e1b4a48bfb",
                                                "look-up-is-what-remains 7 5561e25585c1",
                                                "position-error-rises-slowly 2 6d0daafd710d",
                                                "position-error-rises-at-16 1 749f319eb738",
                                                "alignment-is-the-bottleneck 8 a69d73c78a93",
                                                "color-keeps-position 1 5b6f467ffa2e",
                                                "color-keeps-rotation 1 4e7bfc3bd807",
                                                "yuv-less-sensitive-to-light 2 4afc613e3806",
                                                "yuv-less-sensitive-to-light-own-table 1 c852e91ea109",
                                                "interpolation-of-distinct-postures 1 98e954bf677e",
                                                "15-hz 8 3a4ca0732511",
                                                "15-hz-plain 3 3ff52a4475d4",
                                                "monocular-depth-error 2 206f4ed96421"};

std::string fingerprint(const std::vector<JudgingChange>& judging) {
  std::string text;
  for (const JudgingChange& change : judging)
    text += fmt::format("{}\n{}\n{}\n{}\n", change.date, change.commit.value_or(""), change.rule, change.why);
  return fmt::format("judging {} {}", judging.size(), hash_text(text).substr(0, 12));
}

TEST(ClaimsHistory, EveryClaimAndItsHistoryIsTheOneThatIsWrittenDownHere) {
  std::vector<std::string> fingerprints = {fingerprint(claim_set().judging)};
  for (const Claim& claim : claims()) fingerprints.push_back(fingerprint(claim));
  EXPECT_THAT(fingerprints, testing::ElementsAreArray(kFingerprints))
      << "a claim was changed: add an entry to its history instead, and put the new line here";
}

/// What a program printed; empty if it failed.
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
/// Throws std::runtime_error with the advice if git fails.
std::string git_or_throw(const std::string& folder, const std::string& arguments, const std::string& advice) {
  if (const auto text = git(folder, arguments)) return *text;
  throw std::runtime_error(fmt::format("{}: git {} failed: {}", folder, arguments, advice));
}

/// Every state of claims.json that was committed, oldest first. Empty if the folder has no repository of its own,
/// or git is not installed. Throws std::runtime_error if the repository cannot be read, or not to its first commit.
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

/// The claims of version 1, which had no history: each as one that was written then.
ClaimDefinition definition_of(const json& claim) {
  json set = claim;
  set.erase("id");
  set["withdrawn"] = false;
  json whole = set;
  whole["id"] = claim["id"];
  whole["history"] = {
      {{"date", "2026-01-01"}, {"commit", nullptr}, {"set", set}, {"came_out", nullptr}, {"why", "."}}};
  const json document = {{"format", "glovebench-claims"},
                         {"version", 2},
                         {"judging", {{{"date", "2026-01-01"}, {"commit", nullptr}, {"rule", "."}, {"why", "."}}}},
                         {"claims", {whole}}};
  return parse_claims(document.dump(), "an old claim").claims[0];
}

/// Walks along the histories and says where they are not what was committed.
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

TEST(ClaimsHistory, NothingThatWasCommittedIsGoneOrAnother) {
  const auto states = committed_states(build_paths::source(""));
  if (states.empty()) GTEST_SKIP() << "the sources have no repository, or git is not installed";
  Follower follower;
  for (const auto& [commit, document] : states) {
    if (document["version"] == 1)
      follower.follow(commit, document);
    else
      EXPECT_THAT(tampering(parse_claims(document.dump(), commit), claim_set()), IsEmpty()) << "since " << commit;
  }
}

std::string error_of_states(const std::string& folder) {
  try {
    committed_states(folder);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ClaimsHistory, ARepositoryThatCannotBeReadIsAnErrorAndNoneIsNot) {
  if (!output_of("git --version")) GTEST_SKIP() << "git is not installed";
  const TestFolder folder;
  EXPECT_THAT(committed_states(folder.path()), IsEmpty());
  std::filesystem::create_directory(folder / ".git");
  EXPECT_NE(error_of_states(folder.path()), "no error") << "no repository lies in .git";
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
