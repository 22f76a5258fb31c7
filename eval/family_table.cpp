#include "eval/family_table.h"

#include <algorithm>
#include <array>

#include "eval/experiment.h"
#include "eval/studies/study.h"
#include "render/subjects/subject.h"
#include "reports/metrics/coverage.h"
#include "reports/results.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentKey;
using reports::FrameRecord;

/// What the table measures, in its order. Metrics are those of tracked frames.
struct FamilyColumn {
  std::string_view key;
  std::string_view heading;
  std::optional<bool> (*share)(const FrameRecord& frame);  ///< of the frames with an answer; null: a metric
};
using Share = std::optional<bool>;
constexpr std::array<FamilyColumn, 9> kFamilyColumns = {{
    {"visible_percent", "visible %", [](const FrameRecord& frame) -> Share { return reports::is_visible(frame); }},
    {"found_percent", "found %",
     [](const FrameRecord& frame) {
       return reports::is_visible(frame) && frame.is_judged ? Share(frame.covered) : Share();
     }},
    {"usable_percent", "usable %",
     [](const FrameRecord& frame) { return reports::is_visible(frame) ? is_usable(frame) : Share(); }},
    {"lost_percent", "lost %",
     [](const FrameRecord& frame) -> Share { return frame.status != TrackStatus::tracked; }},
    {"false_lost_percent", "wrongly lost %", [](const FrameRecord& frame) -> Share { return frame.false_lost; }},
    {"position_error_mm", "position mm", nullptr},
    {"rotation_error_deg", "rotation deg", nullptr},
    {"posture_rms_deg", "posture deg", nullptr},
    {"fingertip_error_mm", "fingertips mm", nullptr},
}};

/// The experiments of a family that differ in their movement, and maybe in the person who performs it.
struct FamilyGroup {
  ExperimentKey key;  ///< the first one's, with the family for its trajectory
  std::vector<Experiment> movements;
};

/// Persons are drawn from one population, so they share a group. A movement counts once in it.
bool belongs_to(const FamilyGroup& group, ExperimentKey key, const Experiment& experiment) {
  if (std::min(key.subject, group.key.subject) >= render::kFirstCapsuleSubject) key.subject = group.key.subject;
  return key == group.key && std::ranges::none_of(group.movements, [&](const Experiment& other) {
           return other.key.trajectory == experiment.key.trajectory;
         });
}

std::vector<FamilyGroup> groups_of(std::span<const MeasuredRun> runs) {
  std::vector<FamilyGroup> groups;
  for (const Experiment& experiment : experiments_of(runs)) {
    ExperimentKey key = experiment.key;
    key.trajectory = experiment.runs.front()->run.spec.setting;
    if (key.trajectory.empty()) continue;
    auto group =
        std::ranges::find_if(groups, [&](const FamilyGroup& each) { return belongs_to(each, key, experiment); });
    if (group == groups.end()) group = groups.insert(group, {key, {}});
    group->movements.push_back(experiment);
  }
  return groups;
}

/// The mean of a movement over its frames and noise seeds; empty if none has the value.
std::optional<double> mean_of(const Experiment& movement, const FamilyColumn& column) {
  std::vector<double> values;
  for (const MeasuredRun* run : movement.runs) {
    for (const reports::FrameErrors& errors : run->errors) {
      if (column.share) {
        if (const auto answer = column.share(errors.record)) values.push_back(*answer ? 100 : 0);
      } else if (const auto value = errors.record[column.key]) {
        values.push_back(*value);
      }
    }
  }
  return reports::mean(values);
}

reports::Row row_of(const FamilyGroup& group) {
  const auto [first, last] = std::ranges::minmax_element(
      group.movements, {}, [](const Experiment& movement) { return movement.key.subject; });
  ExperimentKey names = group.key;
  names.subject = first->key.subject;
  reports::Row row = reports::experiment_names(names, last->key.subject);
  int64_t frames = 0;
  std::vector<std::vector<double>> values(kFamilyColumns.size());
  for (const Experiment& movement : group.movements) {
    for (const MeasuredRun* run : movement.runs) frames += std::ssize(run->errors);
    for (size_t c = 0; c < kFamilyColumns.size(); ++c)
      if (const auto value = mean_of(movement, kFamilyColumns[c])) values[c].push_back(*value);
  }
  const auto position = std::ranges::find(kFamilyColumns, "position_error_mm", &FamilyColumn::key);
  row.insert(row.end(),
             {std::ssize(group.movements), frames, std::ssize(values[position - kFamilyColumns.begin()])});
  for (size_t c = 0; c < kFamilyColumns.size(); ++c) {
    auto interval = reports::student_interval(values[c], "movements");
    if (interval && kFamilyColumns[c].share) {
      interval->low = std::max(interval->low, 0.0);
      interval->high = std::min(interval->high, 100.0);
    }
    append(row, cells({reports::mean(values[c]), interval}));
  }
  return row;
}

reports::Table empty_family_table() {
  reports::Table table = {
      "families",
      "Movements by family",
      "Each number is the mean over movements of their own means; low and high are the ends of its 95% interval "
      "(Student's t over movements), so it speaks of other movements of the family, and of other persons where the "
      "movements have several. Fewer than five movements have none, nor have movements that are all equal; those "
      "of "
      "shares are cut at 0 and 100%. Visible: of all frames, "
      "those with at least 30% of the glove's camera-facing area in both images and in the working volume. Of "
      "visible frames, lost ones included: found within 50 mm and 30 degrees; usable within 10 mm and 10 degrees, "
      "fingertips within 20 mm on average. Lost: of all frames, those that the tracker calls lost; wrongly lost: "
      "though the whole hand is in view and in the working volume. Errors are of frames that the tracker answers, "
      "right or wrong, and so of the movements that have such frames (answered).",
      {{"family", "family"},
       {"database", "database"},
       {"truth", "truth"},
       {"noise", "noise"},
       {"movements", "movements", 0},
       {"frames", "frames", 0},
       {"answered_movements", "answered", 0}},
      4,
      {}};
  for (const FamilyColumn& column : kFamilyColumns) {
    const int digits = column.share ? 1 : 2;
    add_with_interval(table.columns, {std::string(column.key), std::string(column.heading), digits});
  }
  return table;
}

}  // namespace

std::optional<reports::StudyResult> family_table(std::span<const MeasuredRun> runs) {
  reports::StudyResult result{"families", "Movements by family", {empty_family_table()}, {}};
  for (const FamilyGroup& group : groups_of(runs)) result.tables[0].rows.push_back(row_of(group));
  if (result.tables[0].rows.empty()) return std::nullopt;
  return result;
}

}  // namespace glovebench::eval
