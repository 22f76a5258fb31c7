#pragma once

#include <vector>

#include "eval/studies/ablations.h"

namespace glovebench::eval {

/// DB_20_random_1, 2, ...: open hand, pinch and power grasp as in DB_20_postures, and as many movement postures as
/// there, drawn at random from the pool that its own were chosen from. `number` is also the seed, >= 1.
PostureSet random_choice(int number);
/// The largest distance of a posture of the pool to the nearest one of the set, degrees RMS.
double covering_radius_deg(const PostureSet& set);

/// DB_20_postures against these.
Ablation posture_choice_ablation(const std::vector<PostureSet>& choices);
/// Runs the default setting with each of them. A database of 20 postures takes 0.9 GB of memory; those of the
/// choices are dropped as soon as they were used.
Runs run_posture_choices(const StudyContext& context, const std::vector<PostureSet>& choices);
/// The table "postures": a row each, DB_20_postures first, which must be among the runs, too.
reports::Table posture_choice_table(const Runs& runs, const std::vector<PostureSet>& choices);

}  // namespace glovebench::eval
