#include <fmt/format.h>

#include <cmath>

#include "eval/studies/study.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Table;
using reports::TruthKind;

constexpr std::string_view kMonocular = "monocular_bbox";

std::vector<Setting> monocular_settings(const TrackerConfig& tracker) {
  std::vector<Setting> settings;
  for (const int subject : {1, 2}) {
    for (const std::string_view method : {kMonocular, kPaperMethod}) {
      settings.push_back(
          {.name = fmt::format("{} of subject {}", method, subject), .tracker = tracker, .subject = subject});
      settings.back().tracker.method = method;
    }
  }
  return settings;
}

/// `value` of the offset (camera frame, m) between estimated and true hand origin, in tracked frames.
Sample offset_sample(const Selection& runs, double (*value)(const Eigen::Vector3d& offset)) {
  return sample_of(runs, [&](const MeasuredRun& each, size_t frame) {
    const TrackResult& answer = each.run.answers[frame];
    const Eigen::Isometry3d& truth = frames_of(each.run.spec)[frame].T_camera_hand;
    const Eigen::Vector3d offset = answer.T_camera_hand.translation() - truth.translation();
    return answer.status == TrackStatus::tracked ? std::optional(value(offset)) : std::nullopt;
  });
}

Estimated depth_error_cm(const Selection& runs) {
  return estimate_mean(offset_sample(runs, [](const Eigen::Vector3d& o) { return 100 * std::abs(o.z()); }));
}

Table empty_monocular_table() {
  return {
      "monocular",
      "Without depth",
      "\"monocular_bbox\" is a method of ours that sees the color image alone: the paper's look-up, then the depth "
      "at which the posed hand fills the bounding box. The paper quotes 5 to 15 cm of depth error for Wang and "
      "Popovic's tracker, which is another method on other data: agreeing with that number does not confirm it. "
      "Depth error is the mean absolute error along the optical axis, lateral error that across it, with every "
      "frame "
      "that the method answers, over the five movements themselves; 95% intervals over blocks of frames. Subject 1 "
      "is the hand that the tracker knows; subject 2 is a hand of another size, which a single camera cannot tell "
      "from one at another distance.",
      {{"method", "method"},
       {"database", "database"},
       {"truth", "truth"},
       {"subject", "subject", 0},
       {"depth_error_cm", "depth cm"},
       {"depth_error_cm_low", "low"},
       {"depth_error_cm_high", "high"},
       {"lateral_error_mm", "lateral mm"},
       {"position_error_mm", "position mm"},
       {"rotation_error_deg", "rotation deg"},
       {"posture_error_deg", "posture deg"},
       {"tracked_percent", "tracked %", 1}},
      4,
      {}};
}

std::vector<Cell> row_of(const Setting& setting, const std::string& database, const Selection& runs) {
  std::vector<Cell> row = {setting.tracker.method, database, std::string(to_string(TruthKind::source)),
                           int64_t{setting.subject}};
  append(row, cells(depth_error_cm(runs)));
  const auto lateral_mm = [](const Eigen::Vector3d& offset) { return 1000 * offset.head<2>().norm(); };
  row.push_back(cell(mean(offset_sample(runs, lateral_mm))));
  for (const char* metric : {"position_error_mm", "rotation_error_deg", "posture_rms_deg"})
    row.push_back(cell(mean(sample_of(runs, metric))));
  row.push_back(cell(tracked_percent(runs)));
  return row;
}

}  // namespace

reports::StudyResult measure_monocular(const StudyContext& context, const std::vector<std::string>& databases) {
  const std::vector<Setting> settings = monocular_settings(context.options.tracker);
  const Runs runs = run_study_settings(context, settings, databases, TruthKind::source);
  Table table = empty_monocular_table();
  for (const Setting& setting : settings)
    for (const std::string& database : databases)
      table.rows.push_back(row_of(setting, database, select(runs, setting.name, database)));
  // The first setting is the monocular method with the tracker's own hand.
  const Estimated depth = depth_error_cm(select(runs, settings.front().name, databases.front()));
  return {"monocular", "Without depth", {table}, {{"monocular.depth_error_cm", "cm", depth.value, depth.interval}}};
}

reports::StudyResult run_monocular(const StudyContext& context) {
  return measure_monocular(context, {"DB_20_postures", "DB_open_pinch_power"});
}

}  // namespace glovebench::eval
