#include <fmt/format.h>

#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "eval/regression/changed_frames.h"
#include "eval/terminal.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::eval {
namespace {

struct Compare {
  std::string baseline_path;
  std::string candidate_path;
  std::string output;
  std::string noise_floor_path;
  reports::PairingOptions pairing;
  ComparisonFlags flags;
  std::vector<std::string> across;
  bool all_rows = false;
  bool quiet = false;

  void run() const {
    if (!output.empty()) reports::require_own_folder(output);
    const FinishedRun baseline = load_finished_run(baseline_path), candidate = load_finished_run(candidate_path);
    reports::PairingOptions options = pairing;
    options.metrics = flags.metrics;
    for (const std::string& what : across) options.across.push_back(from_name<reports::Across>(what).value());
    const std::optional<reports::NoiseFloor> floor = noise_floor(baseline.files, candidate.results.result.suite);
    reports::ComparisonReport report;
    report.comparison = reports::compare_results(baseline.results, candidate.results, floor ? &*floor : nullptr,
                                                 options, flags.config());
    report.times =
        reports::compare_stage_times(load_stage_times(baseline.files), load_stage_times(candidate.files));
    if (!output.empty()) {
      if (across.empty())  // one camera image cannot show two noises or hands
        report.pictures =
            picture_changes(report.comparison, candidate.results.result, baseline.files, candidate.files);
      report.scripts = page_scripts();
      reports::write_comparison(output, report);
    }
    if (quiet && !output.empty()) return;
    fmt::print("{}", reports::comparison_table(report, all_rows, terminal_columns()));
    if (!output.empty()) fmt::print("Report: {}/index.html\n", output);
  }

  /// The given noise floor, else the baseline's if it is of the candidate's suite.
  std::optional<reports::NoiseFloor> noise_floor(const FileSet& baseline, const std::string& suite) const {
    if (!noise_floor_path.empty()) return reports::read_noise_floor(noise_floor_path);
    std::optional<reports::NoiseFloor> floor = load_noise_floor_beside(baseline);
    return floor && floor->suite == suite ? floor : std::nullopt;
  }
};

}  // namespace

void add_compare(Command program) {
  const Command command = program.subcommand(
      "compare",
      "Compare two runs, frame by frame and seed by seed: what became better or worse, by how much, and is it "
      "real?\n"
      "Exit code 3 if they are not comparable: of another protocol, truth, database, noise, subject, hand, or of "
      "other frames.");
  const auto state = std::make_shared<Compare>();
  command.option("baseline", state->baseline_path, "folder of a run, or its results.json").required();
  command.option("candidate", state->candidate_path, "the same, of the run to judge").required();
  command
      .option("-o,--output", state->output,
              "folder for comparison.json, .md, .csv, .tex, junit.xml and a page with pictures")
      .named_file();
  command.option("--noise-floor", state->noise_floor_path,
                 "what other seeds do (`glovebench calibrate noise`) [noise_floor.json beside the baseline]");
  command.option("--other-seeds", state->pairing.other_seeds,
                 "the runs have other noise seeds, as many: pair them in their order");
  command
      .option("--across", state->across,
              "compare although these differ, and say how: noise, subject, frames (then those of both), "
              "hand (and the databases that are built from it)")
      .one_of(all_names<reports::Across>())
      .repeated()
      .comma_separated();
  state->flags.add(command, "all that `glovebench list metrics` marks");
  command.option("--partial", state->pairing.partial, "compare the experiments that both have");
  command.option("--all-rows", state->all_rows, "print also what is the same");
  command.option("-q,--quiet", state->quiet, "print only errors, and results that go to no file");
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
