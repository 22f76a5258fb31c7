#include <fmt/format.h>

#include "core/base/error.h"
#include "core/tracker/method_names.h"
#include "eval/experiment.h"
#include "eval/studies/study.h"
#include "reports/metrics/metric.h"

namespace glovebench::eval {
namespace {

constexpr const char* kDatabase = "DB_20_postures";  // of our own rows
constexpr std::array<std::string_view, 5> kErrors = {"joint_error_mm", "mpjpe_root_mm", "mpjpe_scaled_mm",
                                                     "mpjpe_procrustes_mm", "fingertip_error_mm"};

}  // namespace

reports::StudyResult run_external(const StudyContext& context) {
  const TrackerConfig& theirs = context.options.tracker;
  if (!is_program(theirs.method))
    throw Error("--only external", "--method", theirs.method, "exec:COMMAND, the program to compare with");
  const Runs runs =
      run_study_settings(context,
                         {{.name = "paper", .tracker = profile("paper")},
                          {.name = "recommended", .tracker = profile("recommended")},
                          {.name = "the program", .tracker = theirs},
                          {.name = "the program, bare hand", .tracker = theirs, .appearance = Appearance::skin}},
                         {kDatabase}, reports::TruthKind::source);
  reports::Table table = {"external",
                          "Another program beside ours",
                          "Joints of all five movements (source truth), mean over the tracked frames, by "
                          "alignment: none, root-relative, "
                          "scaled, Procrustes; then fingertips without alignment. Each is over the joints that the "
                          "tracker estimates. Ours "
                          "needs the glove.",
                          {{"tracker", "tracker"}, {"tracked_percent", "tracked %", 1}},
                          1,
                          {}};
  for (const std::string_view key : kErrors) {
    const reports::Metric& metric = reports::metric_of(key);
    table.columns.push_back({std::string(key), std::string(metric.heading)});
  }
  for (const char* name : {"paper", "recommended", "the program", "the program, bare hand"}) {
    const Selection selection = select(runs, name, kDatabase);
    reports::Row& row =
        table.rows.emplace_back(reports::Row{std::string(name), reports::cell(tracked_percent(selection))});
    for (const std::string_view key : kErrors) row.push_back(reports::cell(mean(sample_of(selection, key))));
  }
  return {"external", "Another program beside ours", {table}, {}};
}

}  // namespace glovebench::eval
