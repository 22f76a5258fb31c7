#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "eval/regression/changed_frames.h"
#include "eval/terminal.h"
#include "reports/comparison/comparison_report.h"
#include "reports/comparison/gate_rule.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

constexpr int kGateFailed = 1;

struct Gate {
  std::string candidate_path;
  std::string baseline_folder;
  std::string suite;
  std::string speed_path;
  std::string output;
  reports::PairingOptions pairing;
  bool update = false;

  /// Returns what `make` returns. Also writes its error in place of a report.
  template <typename Make>
  auto or_refusal(Make&& make) const {
    try {
      return make();
    } catch (const Error& e) {
      if (!output.empty()) reports::write_refusal(output, e.what());
      throw;
    }
  }

  /// Returns the exit code. Replaces an earlier gate's report even if it refuses.
  int run() const {
    if (!output.empty()) reports::require_own_folder(output);
    const FinishedRun candidate = or_refusal([&] { return load_finished_run(candidate_path); });
    const std::string folder = or_refusal([&] {
      return baseline_folder.empty() ? default_baseline_folder(suite_name(candidate.results)) : baseline_folder;
    });
    if (!output.empty()) reports::remove_comparison(output);
    return or_refusal([&] { return update ? replace(folder, candidate) : judge(folder, candidate); });
  }

  /// The rows that would have stopped the change, printed; none without an older baseline to compare with.
  std::vector<std::string> accepted_rows(const std::string& folder, const FinishedRun& candidate) const {
    if (!std::filesystem::exists(folder + "/results.json")) return {};
    try {
      const Baseline old = load_baseline(folder);
      const std::vector<std::string> accepted = report(old, folder, candidate, compare(old, candidate)).failures;
      for (const std::string& failure : accepted) fmt::print("ACCEPTED: {}\n", failure);
      return accepted;
    } catch (const reports::Incomparable& e) {
      fmt::print("Not compared with the older baseline: {}\n", e.what());
      return {};
    }
  }

  /// Says what the new baseline changes before making it the baseline.
  int replace(const std::string& folder, const FinishedRun& candidate) const {
    const std::vector<std::string> accepted = accepted_rows(folder, candidate);
    const reports::NamedResult& run = candidate.results;
    update_baseline(folder, run, suite_of(run, suite), measured_speed(), load_stage_times(candidate.files),
                    accepted);
    if (run.result.commit.ends_with("-dirty")) {
      fmt::print("warning: built from a tree with changes: nobody else has this program\n");
    }
    fmt::print("{} is the baseline of suite {} now, in {}\n", run.result.commit, run.result.suite, folder);
    return 0;
  }

  int judge(const std::string& folder, const FinishedRun& candidate) const {
    const Baseline baseline = load_baseline(folder);
    reports::ComparisonReport made = compare(baseline, candidate);
    require_baseline_for_all(made.comparison, folder);
    const reports::GateDecision decision = report(baseline, folder, candidate, made);
    for (const std::string& failure : decision.failures) fmt::print("FAILED: {}\n", failure);
    const std::string page = output.empty() ? "" : fmt::format(". Report: {}/index.html", output);
    if (decision.passed()) {
      fmt::print("Gate passed against {}{}\n", folder, page);
      return 0;
    }
    explain_failure(decision, folder, baseline.noise_floor.has_value());
    fmt::print("Gate failed against {}{}\n", folder, page);
    return kGateFailed;
  }

  /// What the failures mean, and how to accept them.
  void explain_failure(const reports::GateDecision& decision, const std::string& folder, bool has_floor) const {
    const size_t count = decision.failures.size();
    std::string text = fmt::format("{} {} this change. ", count, count == 1 ? "row stops" : "rows stop");
    if (decision.has_places)
      text += fmt::format(
          "Worse in places: the rise lies in few blocks of frames, so that no interval can tell it from chance; "
          "but "
          "on these same frames it is at least twice (a share of frames: once) {}. ",
          has_floor ? "what other noise seeds cause" : "the default minimum effect");
    text += fmt::format(
        "To accept it, e.g. for what became better, run `glovebench gate {} --baseline {} --update`{} and commit "
        "that folder: its provenance.json records the accepted rows and the replaced baseline.",
        candidate_path, folder, suite.empty() ? " (with --suite FILE for a suite of your own)" : "");
    fmt::print("{}", reports::wrapped(text, terminal_columns()));
  }

  reports::ComparisonReport compare(const Baseline& baseline, const FinishedRun& candidate) const {
    reports::ComparisonReport made;
    made.comparison = reports::compare_results(baseline.run.results, candidate.results,
                                               baseline.noise_floor ? &*baseline.noise_floor : nullptr, pairing);
    made.times = reports::compare_stage_times(baseline.times, load_stage_times(candidate.files));
    return made;
  }

  /// Writes and prints the report, but not what stops the change. Accuracy is written before a missing speed can be
  /// an error.
  reports::GateDecision report(const Baseline& baseline, const std::string& folder, const FinishedRun& candidate,
                               reports::ComparisonReport made) const {
    if (!output.empty()) {
      made.scripts = page_scripts();
      made.pictures =
          picture_changes(made.comparison, candidate.results.result, baseline.run.files, candidate.files);
      reports::write_comparison(output, made);
    }
    if (!speed_path.empty()) {
      made.speed = compare_with(baseline, folder);
      if (!output.empty()) reports::write_comparison(output, made);
    }
    const reports::GateDecision decision = decide(made.comparison, made.speed);
    fmt::print("{}", reports::comparison_table(made, false, terminal_columns()));
    if (speed_path.empty() && !baseline.speed.empty())
      fmt::print("warning: no --speed: only the accuracy is gated\n");
    for (const std::string& warning : decision.warnings) fmt::print("warning: {}\n", warning);
    return decision;
  }

  std::vector<reports::SpeedRatio> measured_speed() const {
    return speed_path.empty() ? std::vector<reports::SpeedRatio>{} : reports::read_speed_ratios(speed_path);
  }

  std::vector<reports::SpeedRow> compare_with(const Baseline& baseline, const std::string& folder) const {
    const std::vector<reports::SpeedRatio> measured = measured_speed();
    if (baseline.speed.empty()) {
      throw reports::Incomparable(folder + "/speed.json", "baseline", "none",
                                  "the speed ratios of an earlier run (glovebench gate --speed FILE --update)");
    }
    return reports::compare_speed(baseline.speed, measured, speed_path);
  }

  static std::string suite_name(const reports::NamedResult& candidate) {
    if (!candidate.result.suite.empty()) return candidate.result.suite;
    throw Error(candidate.name, "suite", "none", "the run of a suite (run --suite), or --baseline FOLDER");
  }

  static void require_baseline_for_all(const reports::Comparison& comparison, const std::string& folder) {
    if (comparison.only_in_candidate.empty()) return;
    throw reports::Incomparable(folder, "experiments", fmt::format("no {}", comparison.only_in_candidate.front()),
                                "a baseline for each experiment of the candidate (glovebench gate --update)");
  }
};

}  // namespace

void add_gate(Command program) {
  const Command command = program.subcommand(
      "gate",
      "Compare a run of a suite with the committed baseline and say whether the change may pass.\n"
      "Exit codes: 0 it may, 1 something became worse, 3 there is no baseline or it is not comparable.");
  const auto state = std::make_shared<Gate>();
  command.option("candidate", state->candidate_path, "folder of the run, or its results.json").required();
  command.option("--baseline", state->baseline_folder, "folder of the baseline [ci/baselines/SUITE]").named_file();
  command.option("--speed", state->speed_path,
                 "file of `glovebench_bench --benchmark_repetitions=5 --benchmark_out=FILE`: the ratios to the "
                 "plain implementations are gated, too");
  command.option("--suite", state->suite, "with --update: the file of the suite, if it is one of your own");
  command
      .option("-o,--output", state->output,
              "folder for comparison.json, .md, .csv, .tex, junit.xml and a page with pictures")
      .named_file();
  command.option("--other-seeds", state->pairing.other_seeds,
                 "the run has other noise seeds, as many: pair them in their order");
  command.option("--update", state->update,
                 "make this run the baseline; the noise floor stays, truths are not touched");
  command.runs([state] { return state->run(); });
}

}  // namespace glovebench::eval
