// Runs compare, gate and calibrate noise on the user's own suite.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "ci/build_paths.h"
#include "core/base/hash.h"
#include "eval/program.h"
#include "eval/test_program.h"
#include "reports/results_json.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using reports::RunResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int kGatedFrames = 33;  // two blocks

class RegressionLong : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = test_folder();
    write_file(path("wave.json"), make_trajectory_json("wave", kGatedFrames).dump());
    const nlohmann::json suite = {
        {"format", "glovebench-suite"},
        {"version", 1},
        {"name", "mine"},
        {"description", "a suite of one's own"},
        {"seeds", {1, 2}},
        {"experiments",
         {{{"trajectory", "wave.json"}, {"truth", "source"}, {"databases", {"DB_open_power", "DB_open_pinch"}}}}}};
    write_file(path("mine.json"), suite.dump());
    const auto built = fs::last_write_time(build_paths::program("glovebench")).time_since_epoch().count();
    const std::string name = fmt::format("own-suite-{}", built);
    const std::string run = filled_once(shared_test_folder(), name, [](const std::string& folder) {
      const ProgramRun made = run_suite("run");
      if (made.exit_code != 0) throw std::runtime_error(made.err);  // or others would take a half
      fs::copy(path("run"), folder, fs::copy_options::recursive);
    });
    fs::copy(run, path("run"), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    fs::copy(path("run"), path("same"), fs::copy_options::recursive);
  }

  static std::string path(const std::string& name) { return folder_ + "/" + name; }
  static ProgramRun run_suite(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run", "--suite", path("mine.json"), "-q", "-o", path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  /// The results of "run" with a change that keeps them valid.
  static std::string write_changed(const std::string& name, const std::function<void(RunResult&)>& change) {
    RunResult result = reports::read_results(path("run/results.json"));
    change(result);
    for (reports::ExperimentResult& e : result.experiments) e = summarize(e.key, e.runs, e.pck, e.sequence);
    reports::write_results(path(name + "/results.json"), result);
    return path(name);
  }
  static void add_position_error(RunResult& result, double mm) {
    for (reports::ExperimentResult& experiment : result.experiments)
      for (reports::SeedRun& run : experiment.runs)
        for (reports::FrameRecord& frame : run.frames)
          if (auto& error = frame["position_error_mm"]) *error += mm;
  }
  static ProgramRun gate(const std::string& candidate, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"gate", candidate, "--baseline", path("baseline")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  static void make_baseline() {
    ASSERT_EQ(gate(path("run"), {"--update", "--suite", path("mine.json")}).exit_code, 0);
  }

 private:
  static inline std::string folder_;
};

TEST_F(RegressionLong, EqualRunsAreTheSame) {
  ProgramRun run = run_glovebench({"compare", path("run"), path("same"), "-o", path("report")});
  std::ranges::replace(run.out, '\n', ' ');
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("0 worse, 0 better, 33 same, 0 not enough data; equal in every frame"),
                             HasSubstr("For these trajectories"), HasSubstr("(a default:")));
  for (const char* file :
       {"comparison.json", "comparison.md", "comparison.csv", "comparison.tex", "junit.xml", "index.html"})
    EXPECT_TRUE(fs::exists(path("report/") + file)) << file;
  EXPECT_EQ(run_glovebench({"compare", path("run"), path("same"), "-q", "-o", path("report")}).out, "");
}

TEST_F(RegressionLong, WithoutABaselineNothingPasses) {
  fs::remove_all(path("baseline"));
  const ProgramRun run = gate(path("run"), {"-o", path("refused")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("baseline/results.json"), HasSubstr("--update")));
  EXPECT_THAT(read_file(path("refused/junit.xml")), HasSubstr("<error"));
}

TEST_F(RegressionLong, GateRefusesTheBaselineAsItsOutputAndLeavesIt) {
  fs::remove_all(path("baseline"));
  make_baseline();
  const auto files = read_folder(path("baseline"));
  EXPECT_EQ(gate(path("same"), {"-o", path("baseline")}).exit_code, 2);
  EXPECT_EQ(gate(path("none"), {"-o", path("baseline")}).exit_code, 2);
  EXPECT_EQ(read_folder(path("baseline")), files);
  fs::remove_all(path("baseline"));
}

TEST_F(RegressionLong, GatePassesWhatIsTheSameAndStopsWhatIsWorse) {
  make_baseline();
  EXPECT_EQ(gate(path("same")).exit_code, 0);

  const std::string worse = write_changed("worse", [](RunResult& r) { add_position_error(r, 1); });
  const ProgramRun stopped = gate(worse, {"-o", path("stopped")});
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.out, AllOf(HasSubstr("FAILED: all, position_error_mm: worse by 1.00 mm"),
                                 HasSubstr("\n3 rows stop this change.\nTo accept it"), HasSubstr("--update")));
  EXPECT_THAT(read_file(path("stopped/junit.xml")), HasSubstr("<failure"));
  EXPECT_THAT(gate(worse, {"-q"}).out, AllOf(StartsWith("warning: no noise floor"), HasSubstr("\nFAILED: all, "),
                                             Not(HasSubstr("To accept it"))));

  const ProgramRun better = run_glovebench({"compare", worse, path("run")});
  EXPECT_EQ(better.exit_code, 0);
  EXPECT_THAT(better.out, HasSubstr("0 worse, 3 better"));
  const std::string slightly = write_changed("slightly", [](RunResult& r) { add_position_error(r, 0.19); });
  EXPECT_EQ(gate(slightly).exit_code, 0) << "below the minimum effect";
}

TEST_F(RegressionLong, ThePrintedWayToAcceptWorks) {
  const std::string baseline = path("base line"), suite = path("mine.json");
  const std::string worse = write_changed("worse 'now'", [](RunResult& r) { add_position_error(r, 1); });
  const auto gate_there = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"gate", worse, "--baseline", baseline};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  ASSERT_EQ(run_glovebench({"gate", path("run"), "--baseline", baseline, "--update", "--suite", suite}).exit_code,
            0);
  EXPECT_THAT(gate_there({}).out,
              AllOf(HasSubstr(" --update --suite FILE\n"), HasSubstr("FILE is that of suite mine.")));
  const std::string out = gate_there({"--suite", suite}).out, begin = "\n  glovebench ";
  const size_t at = out.find(begin);
  ASSERT_NE(at, std::string::npos) << out;
  const std::string arguments = out.substr(at + begin.size(), out.find('\n', at + 1) - at - begin.size());
  EXPECT_EQ(std::system((build_paths::program("glovebench") + " " + arguments + " -q").c_str()), 0) << arguments;
  EXPECT_EQ(gate_there({}).exit_code, 0) << "accepted";
}

TEST_F(RegressionLong, AMetricOfOneVersionAloneDecidesNothing) {
  const auto without_residual = [](RunResult& r) { std::erase(r.protocol.metric_keys, "icp_residual_mm"); };
  const std::string fewer = write_changed("fewer", without_residual);
  const std::string fewer_worse = write_changed("fewer-worse", [&](RunResult& r) {
    without_residual(r);
    add_position_error(r, 1);
  });
  make_baseline();
  const ProgramRun passed = gate(fewer);
  EXPECT_EQ(passed.exit_code, 0);
  EXPECT_THAT(passed.out, HasSubstr("\nicp_residual_mm  not in the candidate\n"));
  EXPECT_EQ(gate(fewer_worse).exit_code, 1);

  const std::string results = read_file(fewer + "/results.json");
  json provenance = json::parse(read_file(path("baseline/provenance.json")));
  provenance["results_hash"] = hash_text(results);
  fs::remove(path("baseline/manifest.json"));
  write_file(path("baseline/results.json"), results);
  write_file(path("baseline/provenance.json"), provenance.dump());
  const ProgramRun same = gate(path("same"), {"-o", path("fewer-report")});
  EXPECT_EQ(same.exit_code, 0);
  EXPECT_THAT(same.out, HasSubstr("\nicp_residual_mm  not in the baseline\n"));
  EXPECT_THAT(read_file(path("fewer-report/index.html")),
              HasSubstr(">icp_residual_mm</td><td class=\"name\">not in the baseline</td>"));
  EXPECT_EQ(gate(fewer_worse).exit_code, 1);
}

TEST_F(RegressionLong, LostFramesStopAChangeAndMissingOnesAreNamed) {
  make_baseline();
  const auto lose = [](RunResult& r, int from, int to) {
    for (reports::SeedRun& run : r.experiments[0].runs) {
      for (reports::FrameRecord& frame : run.frames) {
        if (frame.frame < from || frame.frame >= to) continue;
        reports::FrameRecord lost;
        lost.frame = frame.frame;
        lost.timestamp_us = frame.timestamp_us;
        lost.status = TrackStatus::poor_match;
        lost.false_lost = true;
        frame = lost;
      }
    }
  };
  const ProgramRun lost = gate(write_changed("lost", [&](RunResult& r) { lose(r, 20, 25); }));
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_THAT(lost.out, HasSubstr("FAILED: wave_DB_open_power_source_subject1_gradient_1, uncovered_percent"));

  EXPECT_THAT(lost.out, AllOf(HasSubstr("0 worse, "), HasSubstr(" worse in places, "),
                              HasSubstr("Worse in places: the rise lies in few blocks")))
      << "the summary counts what stops";

  const ProgramRun missing = gate(write_changed("missing", [](RunResult& r) {
    for (reports::SeedRun& run : r.experiments[0].runs) run.frames.erase(run.frames.begin() + 20);
  }));
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("frame"), HasSubstr("20"), HasSubstr("wave_DB_open_power")));
}

TEST_F(RegressionLong, RefusesWhatIsNotComparableAndSaysWhy) {
  const auto refusal = [&](const std::string& candidate, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"compare", path("run"), candidate};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_glovebench(arguments);
    EXPECT_EQ(run.exit_code, 3) << run.out;
    return run.err;
  };
  EXPECT_THAT(refusal(write_changed("truth", [](RunResult& r) { r.inputs.truths["source/wave"] = "0f"; })),
              HasSubstr("inputs.truths.source/wave: found 0f"));
  EXPECT_THAT(refusal(write_changed("database", [](RunResult& r) { r.inputs.databases["DB_open_power"] = "0f"; })),
              HasSubstr("inputs.databases.DB_open_power: found 0f"));
  EXPECT_THAT(refusal(write_changed("metrics", [](RunResult& r) { ++r.protocol.metric_definitions; })),
              HasSubstr("metric_definitions"));
  std::string edited = read_file(path("run/results.json"));
  edited.insert(edited.find("\"id\": \"") + 7, "0");
  write_file(path("id/results.json"), edited);
  EXPECT_THAT(refusal(path("id")), HasSubstr("protocol.id: found \"0"));
  make_baseline();
  EXPECT_EQ(gate(path("id")).exit_code, 3);
  write_file(path("baseline/results.json"), edited);
  EXPECT_EQ(gate(path("run")).exit_code, 3) << "an altered baseline";
  fs::remove_all(path("baseline"));
  EXPECT_THAT(refusal(write_changed("part", [](RunResult& r) { r.experiments.pop_back(); })),
              HasSubstr("wave_DB_open_pinch"));
  EXPECT_EQ(run_glovebench({"compare", path("run"), path("part"), "--partial"}).exit_code, 0);
  const std::string seeds = write_changed("seeds", [](RunResult& r) {
    for (reports::ExperimentResult& experiment : r.experiments) experiment.runs[1].seed = 7;
  });
  EXPECT_THAT(refusal(seeds), HasSubstr("seed"));
  EXPECT_EQ(run_glovebench({"compare", path("run"), seeds, "--other-seeds"}).exit_code, 0);
}

TEST_F(RegressionLong, BadInputIsOneLineAndLosesNothing) {
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    const ProgramRun run = run_glovebench(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.out;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(refusal({"compare", path("run"), path("none")}), HasSubstr("none"));
  const std::string results = read_file(path("run/results.json"));
  write_file(path("short/results.json"), results.substr(0, results.size() / 2));
  EXPECT_THAT(refusal({"compare", path("run"), path("short")}), HasSubstr("short/results.json"));
  const std::string page = read_file(path("run/index.html"));
  EXPECT_THAT(refusal({"compare", path("same"), path("run"), "-o", path("run")}), HasSubstr("--output"));
  EXPECT_EQ(read_file(path("run/index.html")), page);
  write_file(path("floor.json"), "{\"format\": \"glovebench-noise-floor\"}");
  EXPECT_THAT(refusal({"compare", path("run"), path("same"), "--noise-floor", path("floor.json")}),
              HasSubstr("floor.json"));
  write_file(path("bench.json"), "[]");
  make_baseline();
  EXPECT_THAT(refusal({"gate", path("run"), "--baseline", path("baseline"), "--speed", path("bench.json")}),
              HasSubstr("bench.json"));
  EXPECT_THAT(refusal({"calibrate", "noise", "-o", path("x")}), HasSubstr("neither"));
  EXPECT_THAT(refusal({"calibrate", "noise", "--run", path("run"), "-o", path("x")}), HasSubstr("mine"));
}

TEST_F(RegressionLong, AnUnfinishedRunIsNoResult) {
  fs::copy(path("run"), path("killed"), fs::copy_options::recursive);
  fs::create_directories(path("killed/.unfinished"));
  make_baseline();
  for (const ProgramRun& run : {gate(path("killed")), run_glovebench({"compare", path("run"), path("killed")})}) {
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.err, AllOf(HasSubstr("killed"), HasSubstr("unfinished")));
  }
}

TEST_F(RegressionLong, OnlyAWholeSuiteOnTheSameTruthBecomesTheBaseline) {
  const std::string baseline = path("updated");
  const auto update = [&](const std::string& candidate) {
    return run_glovebench({"gate", candidate, "--baseline", baseline, "--update", "--suite", path("mine.json")});
  };
  const std::map<std::string, std::string> truths = read_folder(trajectory_folder());
  const ProgramRun unknown = run_glovebench({"gate", path("run"), "--baseline", baseline, "--update"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("suite: found mine, expected families, full, quick"));
  const std::string part = write_changed("half", [](RunResult& r) { r.experiments.pop_back(); });
  EXPECT_EQ(update(part).exit_code, 2);
  EXPECT_FALSE(fs::exists(baseline));

  for (int i = 0; i < 2; ++i) {
    const ProgramRun fine = update(path("run"));
    EXPECT_EQ(fine.exit_code, 0) << fine.err;
  }
  const ProgramRun nameless = run_glovebench({"gate", path("run"), "--baseline", baseline, "--update"});
  EXPECT_EQ(nameless.exit_code, 2);
  EXPECT_EQ(nameless.out, "") << "nothing is accepted before the suite is known";
  EXPECT_EQ(read_file(baseline + "/results.json"), read_file(path("run/results.json")));
  const nlohmann::json provenance = nlohmann::json::parse(read_file(baseline + "/provenance.json"));
  EXPECT_EQ(provenance.at("replaced").at("results_hash"), provenance.at("results_hash"));
  EXPECT_FALSE(provenance.at("times").at("stage_median_ms").empty());
  EXPECT_TRUE(provenance.at("replaced").at("accepted").empty());

  const ProgramRun accepting = update(write_changed("accepted", [](RunResult& r) { add_position_error(r, 1); }));
  EXPECT_EQ(accepting.exit_code, 0) << accepting.err;
  EXPECT_THAT(accepting.out, HasSubstr("ACCEPTED: all, position_error_mm: worse by 1.00 mm"));
  const auto accepted =
      nlohmann::json::parse(read_file(baseline + "/provenance.json")).at("replaced").at("accepted");
  ASSERT_EQ(accepted.size(), 3U);
  EXPECT_THAT(accepted[0].get<std::string>(), HasSubstr("position_error_mm: worse by 1.00 mm"));
  EXPECT_EQ(update(path("run")).exit_code, 0);

  const ProgramRun refused =
      update(write_changed("edited", [](RunResult& r) { r.inputs.truths.at("source/wave") = "0f"; }));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("source/wave"), HasSubstr("delete")));
  EXPECT_EQ(read_file(baseline + "/results.json"), read_file(path("run/results.json")));
  EXPECT_EQ(read_folder(trajectory_folder()), truths) << "truths are not touched";
}

TEST_F(RegressionLong, MeasuresTheNoiseFloorOfAnOwnSuite) {
  ASSERT_EQ(run_suite("many", {"--seed", "101", "--seeds", "8"}).exit_code, 0);
  const ProgramRun run = run_glovebench(
      {"calibrate", "noise", "--run", path("many"), "--suite", path("mine.json"), "-o", path("floors")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("| suite mine | all, same seeds |"));
  const ProgramRun compared =
      run_glovebench({"compare", path("run"), path("same"), "--noise-floor", path("floors/mine/noise_floor.json")});
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("(measured over"));
  const ProgramRun few = run_glovebench(
      {"calibrate", "noise", "--run", path("run"), "--suite", path("mine.json"), "-o", path("floors")});
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_THAT(few.err, HasSubstr("at least 8"));
}

TEST_F(RegressionLong, PicturesTheWorstFrames) {
  // One of the program's own trajectories, since a comparison has no others.
  const std::vector<std::string> arguments = {"run",     "--suite", "quick", "--filter", "Exit_*",
                                              "--seeds", "1",       "-q",    "-o",       path("exit")};
  ASSERT_EQ(run_glovebench(arguments).exit_code, 0);
  fs::copy(path("exit"), path("exit-worse"), fs::copy_options::recursive);
  fs::remove(path("exit-worse/manifest.json"));  // of other results
  RunResult result = reports::read_results(path("exit/results.json"));
  reports::ExperimentResult& e = result.experiments[0];
  *e.runs[0].frames[5]["vertex_error_mm"] += 20;
  e = summarize(e.key, e.runs, e.pck, e.sequence);
  reports::write_results(path("exit-worse/results.json"), result);
  const ProgramRun run = run_glovebench({"compare", path("exit"), path("exit-worse"), "-o", path("pictures")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(
      read_file(path("pictures/index.html")),
      AllOf(HasSubstr("data:image/png"), HasSubstr("Exit_DB_open_power_source_subject1_gradient_1, frame 5")));
}

}  // namespace
}  // namespace glovebench::eval
