
#include "core/base/error.h"
#include "core/tracker/tracker_config.h"
#include "eval/streaming.h"
#include "eval/studies/study.h"
#include "reports/metrics/metric.h"

namespace glovebench::eval {
namespace {

using reports::Table;

constexpr const char* kDatabase = "DB_20_postures";  // of our own rows
constexpr std::array<std::string_view, 5> kErrors = {"joint_error_mm", "mpjpe_root_mm", "mpjpe_scaled_mm",
                                                     "mpjpe_procrustes_mm", "fingertip_error_mm"};

std::vector<Setting> settings_beside(const TrackerConfig& theirs) {
  return {{.name = "paper", .tracker = profile("paper")},
          {.name = "recommended", .tracker = profile("recommended")},
          {.name = "the program", .tracker = theirs},
          {.name = "the program, bare hand", .tracker = theirs, .appearance = Appearance::skin}};
}

Table empty_table() {
  Table table = {
      "external",
      "Another program beside ours",
      "Joints of all five movements (source truth), mean over the tracked frames, by alignment: none, "
      "root-relative, scaled, Procrustes; then fingertips without alignment. Each is over the joints that "
      "the tracker estimates. Ours needs the glove.",
      {{"tracker", "tracker"}, {"tracked_percent", "tracked %", 1}},
      1,
      {}};
  for (const std::string_view key : kErrors)
    table.columns.push_back({std::string(key), std::string(reports::metric_of(key).heading)});
  return table;
}

reports::Row row_of(const std::string& name, const Runs& runs) {
  const Selection selection = select(runs, name, kDatabase);
  reports::Row row = {name, reports::cell(tracked_percent(selection))};
  for (const std::string_view key : kErrors) row.push_back(reports::cell(mean(sample_of(selection, key))));
  return row;
}

}  // namespace

reports::StudyResult run_external(const StudyContext& context) {
  const TrackerConfig& theirs = context.options.tracker;
  if (!is_program(theirs.method))
    throw Error("--only external", "--method", theirs.method, "exec:COMMAND, the program to compare with");
  Table errors = empty_table();
  std::vector<std::pair<std::string, reports::StudyResult>> streamed;
  for (const Setting& setting : settings_beside(theirs)) {
    const std::vector<RunSpec> specs = study_specs(context, {setting}, {kDatabase}, reports::TruthKind::source);
    // One job, nothing stored: this process measures the times, which tell what a live system drops.
    const Runs runs = measure(context.workbench, execute(context.workbench, specs, {}));
    errors.rows.push_back(row_of(setting.name, runs));
    streamed.emplace_back(setting.name, streaming_study(context.workbench, {}, runs));
  }
  return {"external", errors.title, {errors, joined_streaming(streamed).tables.front()}, {}};
}

}  // namespace glovebench::eval
