#pragma once

#include <vector>

#include "eval/studies/ablations.h"

namespace glovebench::eval {

/// DB_20_random_NUMBER: DB_20_postures with random movement postures from the same pool. `number` >= 1 is the seed.
PostureSet random_choice(int number);
/// Largest distance from a pool posture to the set, RMS.
double covering_radius_deg(const PostureSet& set);

/// Compares DB_20_postures with `choices`.
Ablation posture_choice_ablation(const std::vector<PostureSet>& choices);
/// Runs the default setting with each choice. Frees each database (0.9 GB) after use.
Runs run_posture_choices(const StudyContext& context, const std::vector<PostureSet>& choices);
/// Table "postures": a row each, DB_20_postures (required in `runs`) first.
reports::Table posture_choice_table(const Runs& runs, const std::vector<PostureSet>& choices);

}  // namespace glovebench::eval
