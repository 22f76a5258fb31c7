#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "eval/commands/options.h"
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
  bool quiet = false;

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

  /// The rows that would have stopped the change; none without an older baseline to compare with.
  std::vector<std::string> accepted_rows(const std::string& folder, const FinishedRun& candidate) const {
    if (!std::filesystem::exists(folder + "/results.json")) return {};
    try {
      const Baseline old = load_baseline(folder);
      return report(old, folder, candidate, compare(old, candidate)).failures;
    } catch (const reports::Incomparable& e) {
      fmt::print("Not compared with the older baseline: {}\n", e.what());
      return {};
    }
  }

  /// Makes the candidate the baseline and says what that accepts.
  int replace(const std::string& folder, const FinishedRun& candidate) const {
    const reports::NamedResult& run = candidate.results;
    const bool has_suite = !run.result.suite.empty() || !suite.empty();
    const std::optional<Suite> whole = has_suite ? std::optional(suite_of(run, suite)) : std::nullopt;
    const std::vector<std::string> accepted = accepted_rows(folder, candidate);
    update_baseline(folder, run, whole, measured_speed(), load_stage_times(candidate.files), accepted);
    if (run.result.commit.ends_with("-dirty"))
      fmt::print("warning: built from a tree with changes: nobody else has this program\n");
    if (quiet) return 0;
    for (const std::string& row : accepted) fmt::print("ACCEPTED: {}\n", row);
    const std::string name = run.result.suite.empty() ? "" : " of suite " + run.result.suite;
    fmt::print("{} is the baseline{} now, in {}\n", run.result.commit, name, folder);
    return 0;
  }

  int judge(const std::string& folder, const FinishedRun& candidate) const {
    const Baseline baseline = load_baseline(folder);
    reports::ComparisonReport made = compare(baseline, candidate);
    require_baseline_for_all(made.comparison, folder);
    const reports::GateDecision decision = report(baseline, folder, candidate, made);
    for (const std::string& failure : decision.failures) fmt::print("FAILED: {}\n", failure);
    if (quiet) return decision.passed() ? 0 : kGateFailed;
    const std::string page = output.empty() ? "" : fmt::format(". Report: {}/index.html", output);
    if (decision.passed()) {
      fmt::print("Gate passed against {}{}\n", folder, page);
      return 0;
    }
    explain_failure(decision, baseline.noise_floor.has_value());
    print_acceptance(folder, candidate.results.result.suite);
    fmt::print("Gate failed against {}{}\n", folder, page);
    return kGateFailed;
  }

  /// Prints what the failures mean.
  static void explain_failure(const reports::GateDecision& decision, bool has_floor) {
    const size_t count = decision.failures.size();
    std::string text = fmt::format("{} {} this change. ", count, count == 1 ? "row stops" : "rows stop");
    if (decision.has_places)
      text += fmt::format(
          "Worse in places: the rise lies in few blocks of frames, so that no interval can tell it from chance; "
          "but "
          "on these same frames it is at least twice (a share of frames: once) {}. ",
          has_floor ? "what other noise seeds cause" : "the default minimum effect");
    fmt::print("{}", reports::wrapped(text, terminal_columns()));
  }

  /// The command that makes the candidate the baseline, in one line to copy.
  void print_acceptance(const std::string& folder, const std::string& suite_of_run) const {
    const std::vector<std::string> built_in = suite_names();
    const bool needs_file = !suite_of_run.empty() && std::ranges::find(built_in, suite_of_run) == built_in.end();
    std::string flags = " --update";
    if (needs_file) flags += " --suite " + (suite.empty() ? "FILE" : reports::shell_quoted(suite));
    if (!speed_path.empty()) flags += " --speed " + reports::shell_quoted(speed_path);
    if (pairing.other_seeds) flags += " --other-seeds";
    fmt::print("To accept it, e.g. for what became better:\n  glovebench gate {} --baseline {}{}\n",
               reports::shell_quoted(candidate_path), reports::shell_quoted(folder), flags);
    const std::string file =
        needs_file && suite.empty() ? fmt::format("FILE is that of suite {}. ", suite_of_run) : "";
    fmt::print("{}",
               reports::wrapped(file + "Commit the baseline's folder: its provenance.json records the accepted "
                                       "rows and the replaced baseline.",
                                terminal_columns()));
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
    if (!quiet) fmt::print("{}", reports::comparison_table(made, false, terminal_columns()));
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
  command.option("-q,--quiet", state->quiet, "print only warnings and what stops the change");
  command.runs([state] { return state->run(); });
}

}  // namespace glovebench::eval
