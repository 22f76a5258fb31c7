#include <fmt/format.h>

#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/settings_run.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

struct TableCommand {
  std::vector<std::string> runs;
  std::string format = "text";
  ComparisonFlags flags;
  bool other_seeds = false;
  bool partial = false;
  bool quiet = false;

  void run() const {
    reports::PairingOptions pairing{other_seeds, partial, {}, flags.metrics};
    const reports::SettingsTable table = settings_table(runs, pairing, flags.config());
    if (format == "markdown") return fmt::print("{}", settings_markdown(table));
    if (format == "csv") return fmt::print("{}", settings_csv(table));
    if (format == "latex") return fmt::print("{}", settings_latex(table));
    if (format == "html") return fmt::print("{}", settings_html(table, page_scripts()));
    fmt::print("{}",
               quiet ? to_text(table.table, true, terminal_columns()) : settings_text(table, terminal_columns()));
  }
};

}  // namespace

void add_table(Command program) {
  const Command command = program.subcommand(
      "table",
      "Compare several runs of the same frames in one table: errors, times, and which settings to take.\n"
      "The reference is the run with the paper's settings, else the first. Exit code 3 if runs are not "
      "comparable.");
  const auto state = std::make_shared<TableCommand>();
  command.option("runs", state->runs, "folders of runs, two or more; a row is named after its folder").required();
  command.option("--format", state->format, "of the output").one_of({"text", "markdown", "csv", "latex", "html"});
  state->flags.add(command, fmt::format("{}", fmt::join(reports::headline_metrics(), ", ")));
  command.option("--other-seeds", state->other_seeds,
                 "the runs have other noise seeds, as many: pair them in their order");
  command.option("--partial", state->partial, "compare the experiments that the reference shares with each");
  command.option("-q,--quiet", state->quiet, "print only the table, without explanations");
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
