#include "eval/suite.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/test_error.h"
#include "eval/test_program.h"
#include "reports/results_json.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json make_suite() {
  return json::parse(R"({
    "format": "glovebench-suite", "version": 1, "name": "mine", "description": "two", "seeds": [3, 5],
    "experiments": [
      {"trajectory": "Tr4", "truth": "source", "databases": ["DB_open_power"]},
      {"trajectory": "Tr4", "truth": "source", "databases": ["DB_20_postures", "own.csv"]},
      {"trajectory": "own.json", "truth": "source", "databases": ["DB_open_power"], "subject": 2,
       "noise": {"model": "kinect", "factor": 0.5}, "frames": {"first": 1, "count": 2}}
    ]})");
}

std::string refusal_of(const json& suite) {
  const std::string error = thrown_by([&] { parse_suite(suite.dump(), "folder/mine.json"); });
  EXPECT_THAT(error, AllOf(HasSubstr("folder/mine.json: "), Not(HasSubstr("\n")))) << suite;
  return error;
}

/// The suite's own files lie in a folder of the test.
class SuitePlan : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_ + "/own.json", make_trajectory_json("own", 4).dump());
    json left = make_trajectory_json("left", 4);
    left["side"] = "left";
    write_file(folder_ + "/left.json", left.dump());
    const std::string gestures =
        read_file(std::filesystem::path(build_paths::program("glovebench")).parent_path().parent_path() /
                  "share/glovebench/trajectories/data/gestures.csv");
    write_file(folder_ + "/own.csv", gestures);
  }

  Plan plan(const json& suite, const std::string& filter = "") const {
    WorkbenchConfig config = test_workbench();
    config.cache_folder = folder_ + "/cache";
    Workbench workbench(config);
    const Plan planned =
        plan_suite(workbench, profile("paper"), parse_suite(suite.dump(), folder_ + "/mine.json"), filter);
    EXPECT_THAT(describe_plan(workbench, planned), HasSubstr("database DB_open_power: to be built"));
    EXPECT_FALSE(std::filesystem::exists(config.cache_folder)) << "planning builds nothing";
    return planned;
  }
  std::string refused_plan(const json& suite) const {
    return thrown_by([&] { plan(suite); });
  }

  const std::string folder_ = test_folder();
};

TEST(Suite, ReadsWhatIsThere) {
  const Suite suite = parse_suite(make_suite().dump(), "folder/mine.json");
  EXPECT_EQ(suite.name, "mine");
  EXPECT_THAT(suite.seeds, ElementsAre(3, 5));
  ASSERT_EQ(suite.entries.size(), 3U);
  EXPECT_EQ(suite.entries[0].trajectory, "Tr4");
  EXPECT_EQ(suite.entries[0].noise, reports::NoiseSetting{});
  EXPECT_THAT(suite.entries[1].databases, ElementsAre("DB_20_postures", "folder/own.csv"));
  EXPECT_EQ(suite.entries[2].trajectory, "folder/own.json");
  EXPECT_EQ(suite.entries[2].subject, 2);
  EXPECT_EQ(suite.entries[2].noise, (reports::NoiseSetting{"kinect", 0.5}));
  EXPECT_EQ(suite.entries[2].frames.first, 1);
  EXPECT_EQ(suite.entries[2].frames.count, 2);
}

TEST(Suite, RefusesWhatItDoesNotKnow) {
  const auto changed = [](const std::string& place, const json& value) {
    json suite = make_suite();
    suite[json::json_pointer(place)] = value;
    return refusal_of(suite);
  };
  EXPECT_THAT(changed("/format", "glovebench-trajectory"), HasSubstr("glovebench-suite"));
  EXPECT_THAT(changed("/version", 2), HasSubstr("version"));
  EXPECT_THAT(changed("/name", "../x"), HasSubstr("name"));
  EXPECT_THAT(changed("/bogus", 1), HasSubstr("bogus"));
  EXPECT_THAT(changed("/seeds", json::array()), HasSubstr("seeds"));
  EXPECT_THAT(changed("/seeds/1", 3), AllOf(HasSubstr("seeds[1]"), HasSubstr("each seed once")));
  EXPECT_THAT(changed("/seeds/1", -1), HasSubstr("seeds[1]"));
  EXPECT_THAT(changed("/experiments", json::array()), HasSubstr("experiments"));
  EXPECT_THAT(changed("/experiments/1/tracker", "paper"), AllOf(HasSubstr("experiments[1]"), HasSubstr("tracker")));
  EXPECT_THAT(changed("/experiments/1/truth", "both"),
              AllOf(HasSubstr("experiments[1].truth"), HasSubstr("recorded or source")));
  EXPECT_THAT(changed("/experiments/1/databases", json::array()), HasSubstr("experiments[1].databases"));
  EXPECT_THAT(changed("/experiments/2/subject", 23), HasSubstr("experiments[2].subject"));
  EXPECT_THAT(changed("/experiments/2/noise/model", "loud"), HasSubstr("experiments[2].noise.model"));
  EXPECT_THAT(changed("/experiments/2/noise/factor", -1), HasSubstr("experiments[2].noise.factor"));
  EXPECT_THAT(changed("/experiments/2/frames/count", 0), HasSubstr("experiments[2].frames.count"));
}

TEST(Suite, RefusesAnExperimentThatCountsTwice) {
  json suite = make_suite();
  suite["experiments"][1]["databases"][1] = "DB_open_power";
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[1].databases[1]: found \"DB_open_power\""));
  suite["experiments"][1]["subject"] = 2;
  EXPECT_EQ(parse_suite(suite.dump(), "mine.json").entries.size(), 3U) << "another hand, another experiment";
}

json make_family_suite() {
  json suite = make_suite();
  suite["experiments"][2] = {
      {"family", "side"}, {"movements", {{"first", 3}, {"count", 2}}}, {"databases", {"DB_open_power"}}};
  return suite;
}

TEST(Suite, ReadsMovementsOfAFamily) {
  const Suite suite = parse_suite(make_family_suite().dump(), "folder/mine.json");
  ASSERT_EQ(suite.entries.size(), 4U);
  EXPECT_EQ(suite.entries[2].trajectory, "side_3");
  EXPECT_EQ(suite.entries[3].trajectory, "side_4");
  EXPECT_EQ(suite.entries[3].truth, reports::TruthKind::source);
  EXPECT_THAT(suite.entries[3].databases, ElementsAre("DB_open_power"));
}

TEST(Suite, PersonsPerformTheMovementsOfAFamilyInTurn) {
  json suite = make_family_suite();
  suite["experiments"][2]["movements"]["count"] = 5;
  const auto subjects_of = [&suite] {
    std::vector<int> subjects;
    for (const SuiteEntry& entry : parse_suite(suite.dump(), "mine.json").entries)
      if (entry.trajectory.starts_with("side_")) subjects.push_back(entry.subject);
    return subjects;
  };
  EXPECT_THAT(subjects_of(), ElementsAre(1, 1, 1, 1, 1));
  suite["experiments"][2]["subject"] = 7;
  EXPECT_THAT(subjects_of(), ElementsAre(7, 7, 7, 7, 7));
  suite["experiments"][2]["subjects"] = {{"first", 21}, {"count", 2}};
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[2].subjects"));
  suite["experiments"][2].erase("subject");
  EXPECT_THAT(subjects_of(), ElementsAre(21, 22, 21, 22, 21));
  suite["experiments"][2]["subjects"]["count"] = 3;
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[2].subjects.first: found 21"));
  suite["experiments"][2]["subjects"] = {{"first", 3}, {"count", 23}};
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[2].subjects.count: found 23"));
  json named = make_suite();
  named["experiments"][0]["subjects"] = {{"first", 3}, {"count", 2}};
  EXPECT_THAT(refusal_of(named), HasSubstr("subjects")) << "one trajectory has no turns";
}

TEST(Suite, RefusesMovementsThatDoNotExist) {
  const auto changed = [](const std::string& place, const json& value) {
    json suite = make_family_suite();
    suite[json::json_pointer("/experiments/2" + place)] = value;
    return refusal_of(suite);
  };
  EXPECT_THAT(changed("/family", "sideways"),
              AllOf(HasSubstr("experiments[2].family: found \"sideways\""), HasSubstr("side,")));
  EXPECT_THAT(changed("/movements/count", 0), HasSubstr("experiments[2].movements.count: found 0"));
  EXPECT_THAT(changed("/movements/count", 100'000), HasSubstr("experiments[2].movements.count"));
  EXPECT_THAT(changed("/movements/first", 1'000'000), HasSubstr("experiments[2].movements.first"));
  EXPECT_THAT(changed("/movements", json::object()), HasSubstr("experiments[2].movements"));
  EXPECT_THAT(changed("/trajectory", "Tr4"), HasSubstr("trajectory"));
  json suite = make_family_suite();
  suite["experiments"][1] = suite["experiments"][2];
  suite["experiments"][1]["movements"] = {{"first", 4}, {"count", 1}};
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[2].databases[0]: found \"DB_open_power\", expected an "
                                           "experiment that is not yet in the suite"));
  suite["experiments"][1]["movements"] = {{"first", 10}, {"count", 10'000}};
  EXPECT_THAT(refusal_of(suite), HasSubstr("experiments[1]: found one more experiment, expected at most 10000"));
}

TEST(Suite, DamagedFilesAreRefusedOrValid) {
  const std::string text = make_suite().dump(1);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    RandomStream random(1, "suite_test", i, "damage");
    std::string damaged = text;
    for (uint64_t d = 0; d <= random.index(3); ++d) {
      const size_t at = random.index(damaged.size() - 1);
      const std::vector<std::string> tokens = {"", "\"", "[[[[", "{", "1e999", "-1", "null", "\xff", "0"};
      damaged.replace(at, 1 + random.index(6), tokens[random.index(tokens.size())]);
    }
    try {
      const Suite suite = parse_suite(damaged, "damaged");
      EXPECT_THAT(suite.seeds, Not(IsEmpty()));
      EXPECT_THAT(suite.entries, Not(IsEmpty()));
      ++accepted;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("damaged: "), Not(HasSubstr("\n"))));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(accepted, 0);  // changed letters of the description are accepted, so the damage reaches the values
}

TEST_F(SuitePlan, RendersAFrameOnceForAllItsDatabases) {
  const Plan planned = plan(make_suite());
  EXPECT_EQ(planned.suite, "mine");
  std::vector<std::string> databases;
  std::vector<uint64_t> seeds;
  for (const RunSpec& spec : planned.specs) {
    databases.push_back(spec.database);
    seeds.push_back(spec.seed);
  }
  EXPECT_THAT(databases, ElementsAre("DB_open_power", "DB_20_postures", "own", "DB_open_power", "DB_20_postures",
                                     "own", "DB_open_power", "DB_open_power"));
  EXPECT_THAT(seeds, ElementsAre(3, 3, 3, 5, 5, 5, 3, 5));
  for (size_t s = 1; s < 6; ++s) EXPECT_TRUE(share_images(planned.specs[0], planned.specs[s])) << s;
  EXPECT_FALSE(share_images(planned.specs[5], planned.specs[6]));
  EXPECT_EQ(frames_of(planned.specs[6]).size(), 2U);
  EXPECT_EQ(planned.specs[6].subject, 2);
}

TEST_F(SuitePlan, FilterLeavesWhatMatches) {
  const Plan planned = plan(make_suite(), "*_DB_open_power_*");
  ASSERT_EQ(planned.specs.size(), 4U);
  for (const RunSpec& spec : planned.specs) EXPECT_EQ(spec.database, "DB_open_power");
  EXPECT_EQ(list_experiments(planned),
            "Tr4_DB_open_power_source_subject1_gradient_1   117 frames x 2 seeds\n"
            "own_DB_open_power_source_subject2_kinect_0.5     2 frames x 2 seeds\n");
  EXPECT_THAT(thrown_by([&] { plan(make_suite(), "Tr5*"); }),
              AllOf(HasSubstr("Tr5*"), HasSubstr("Tr4_DB_open_power"), HasSubstr("--list")))
      << "nothing is left";
}

TEST_F(SuitePlan, RefusesTrajectoriesThatDoNotFit) {
  const auto with_third = [](const std::string& key, const json& value) {
    json suite = make_suite();
    suite["experiments"][2][key] = value;
    return suite;
  };
  EXPECT_THAT(refused_plan(with_third("trajectory", "left.json")),
              AllOf(HasSubstr("left.json"), HasSubstr("side")));
  EXPECT_THAT(refused_plan(with_third("truth", "recorded")), AllOf(HasSubstr("own.json"), HasSubstr("kind")));
  EXPECT_THAT(refused_plan(with_third("trajectory", "Tr9")), AllOf(HasSubstr("Tr9"), HasSubstr("Tr5")));
  EXPECT_THAT(refused_plan(with_third("frames", {{"first", 3}, {"count", 2}})), HasSubstr("own"));
  write_file(folder_ + "/twin.json", make_trajectory_json("own", 3).dump());
  json suite = make_suite();
  suite["experiments"][0]["trajectory"] = "twin.json";
  EXPECT_THAT(refused_plan(suite), AllOf(HasSubstr("own.json: name"), HasSubstr("not yet in the run")));
}

TEST_F(SuitePlan, FullHoldsFigure4AndQuick) {
  Workbench workbench(test_workbench());
  const auto names = [](const Plan& plan) {
    std::set<std::string> experiments;
    for (const RunSpec& spec : plan.specs) experiments.insert(to_string(key_of(spec)));
    return experiments;
  };
  const auto planned = [&](const std::string& suite) {
    return names(plan_suite(workbench, profile("paper"), load_suite(suite), ""));
  };
  EXPECT_THAT(suite_names(), ElementsAre("families", "full", "quick"));
  const std::set<std::string> full = planned("full"), quick = planned("quick");
  const std::set<std::string> figure4 = names(plan_figure4(profile("paper"), {}));
  EXPECT_EQ(figure4.size(), 45U);
  EXPECT_EQ(quick.size(), 4U);
  EXPECT_TRUE(std::ranges::includes(full, figure4));
  EXPECT_TRUE(std::ranges::includes(full, quick)) << "a night judges what a commit judges";
  EXPECT_EQ(full.size(), 48U);
}

TEST_F(SuitePlan, ListsTheExperimentsInTheOrderOfTheBaselines) {
  Workbench workbench(test_workbench());
  for (const std::string suite : {"quick", "full"}) {
    std::vector<std::string> planned, of_baseline;
    for (const RunSpec& spec : plan_suite(workbench, profile("paper"), load_suite(suite), "").specs) {
      const std::string name = to_string(key_of(spec));
      if (std::ranges::count(planned, name) == 0) planned.push_back(name);
    }
    const std::string path = build_paths::source("ci/baselines/" + suite + "/results.json");
    for (const reports::ExperimentResult& experiment : reports::read_results(path).experiments)
      of_baseline.push_back(to_string(experiment.key));
    EXPECT_EQ(planned, of_baseline) << suite;
  }
}

TEST_F(SuitePlan, FamiliesHoldsTenMovementsOfEach) {
  Workbench workbench(test_workbench());
  const Plan planned = plan_suite(workbench, profile("paper"), load_suite("families"), "");
  std::map<std::string, int> movements;
  std::set<int> subjects;
  for (const RunSpec& spec : planned.specs) {
    subjects.insert(spec.subject);
    EXPECT_EQ(frames_of(spec).size(), 100U);
    EXPECT_TRUE(spec.trajectory->name.starts_with(spec.setting + "_")) << spec.trajectory->name;
    ++movements[spec.setting];
  }
  EXPECT_EQ(movements.size(), trajectories::movement_families().size());
  for (const auto& [family, count] : movements) EXPECT_EQ(count, 10) << family;
  EXPECT_EQ(subjects.size(), 20U) << "nobody is left out";
  EXPECT_EQ(*subjects.begin(), render::kFirstCapsuleSubject) << "none of them has the tracker's mesh";
}

TEST_F(SuitePlan, UnknownNamesAreListed) {
  EXPECT_THAT(thrown_by([] { load_suite("bogus"); }), AllOf(HasSubstr("bogus"), HasSubstr("full, quick")));
}

}  // namespace
}  // namespace glovebench::eval
