#pragma once

#include <string>
#include <vector>

#include "eval/studies/study.h"

namespace glovebench::eval {

/// One way to do a thing, as a row of the table.
struct AblationRow {
  std::string label;    ///< to read: "color-blind"
  std::string setting;  ///< a name of `ablation_settings`
  std::string database;
};
/// The same thing done in several ways, over the same frames. The first row is what the others are compared with.
struct Ablation {
  std::string name;
  std::vector<AblationRow> rows;
};

/// The setting that every other one departs from in one respect.
inline constexpr const char* kDefaultSetting = "default";
/// All settings that rows may name.
std::vector<Setting> ablation_settings(const TrackerConfig& tracker);
/// What the tracker, its database or the scene is changed in; but for the choice of postures. The labels
/// of default rows are true of the profile `paper`.
std::vector<Ablation> ablations();

/// Runs what the rows of these ablations name, on the source truth, each once: with DB_open_power over the
/// movements that grasp like that, with all others over all five.
Runs run_rows(const StudyContext& context, const std::vector<Ablation>& wanted);

/// The table "ablations": a row each.
reports::Table ablation_table(const Runs& runs, const std::vector<Ablation>& ablations);

/// A look-up that is off by more than this is wrong: about a quarter of the way from the open hand to the power
/// grasp (57 degrees).
inline constexpr double kWrongLookUp_deg = 15;

/// lag.frames, lag.without_filter_frames, lag.filter_share: the posture's delay. The intervals draw movements.
std::vector<reports::Measure> lag_measures(const Runs& runs);

/// By what alignment without colors is worse in frames whose look-up is wrong, with DB_20_postures and
/// DB_open_pinch_power together: color.blind_excess_position_mm, color.blind_excess_rotation_deg.
std::vector<reports::Measure> color_measures(const Runs& runs);
/// The table "color_blind": the same frames, for each of the two databases.
reports::Table color_table(const Runs& runs);

/// interpolation.distinct_excess_deg: posture error, before the filter, of 3 neighbors minus that of 1, in frames
/// where the 3 are not all of one posture.
reports::Measure interpolation_measure(const Runs& runs);

/// The rows that these need and that `ablations` may not have.
std::vector<Ablation> measured_ablations();

}  // namespace glovebench::eval
