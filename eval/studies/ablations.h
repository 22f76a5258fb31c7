#pragma once

#include <string>
#include <vector>

#include "eval/studies/study.h"

namespace glovebench::eval {

struct AblationRow {
  std::string label;    ///< "color-blind"
  std::string setting;  ///< name in `ablation_settings`
  std::string database;
};
/// One thing in several ways on the same frames. Rows compare with the first.
struct Ablation {
  std::string name;
  std::vector<AblationRow> rows;
};

inline constexpr const char* kDefaultSetting = "default";
std::vector<Setting> ablation_settings(const TrackerConfig& tracker);
/// All but the choice of postures. Labels assume the profile `paper`.
std::vector<Ablation> ablations();

/// Runs on source truths: DB_open_power on power grasps, other databases on all five.
Runs run_rows(const StudyContext& context, const std::vector<Ablation>& wanted);

reports::Table ablation_table(const Runs& runs, const std::vector<Ablation>& ablations);

/// A look-up with a larger error is wrong: a quarter of the way from open hand to power grasp.
inline constexpr double kWrongLookUp_deg = 15;

/// lag.*: the posture's delay. Intervals resample movements.
std::vector<reports::Measure> lag_measures(const Runs& runs);

/// color.*: excess error of color-blind alignment in frames with a wrong look-up, in DB_20_postures and
/// DB_open_pinch_power.
std::vector<reports::Measure> color_measures(const Runs& runs);
/// Table "color_blind".
reports::Table color_table(const Runs& runs);

/// Unfiltered posture error of 3 neighbors minus that of 1, where the 3 postures differ.
reports::Measure interpolation_measure(const Runs& runs);

/// Rows for these measures beyond `ablations`.
std::vector<Ablation> measured_ablations();

/// DB_20_random_NUMBER: DB_20_postures with random movement postures from the same pool. `number`: seed, >= 1.
PostureSet random_choice(int number);
/// Largest RMS distance from a pool posture to the set.
double covering_radius_deg(const PostureSet& set);

Ablation posture_choice_ablation(const std::vector<PostureSet>& choices);
/// Runs the default setting. Frees each database after use.
Runs run_posture_choices(const StudyContext& context, const std::vector<PostureSet>& choices);
/// DB_20_postures first, which `runs` must include.
reports::Table posture_choice_table(const Runs& runs, const std::vector<PostureSet>& choices);

}  // namespace glovebench::eval
