#include "eval/studies/ablations.h"

#include <fmt/format.h>

#include "core/base/math.h"
#include "core/base/random.h"
#include "eval/program.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/data_files.h"
#include "trajectories/generation/low_dispersion.h"

namespace glovebench::eval {
namespace {

using reports::Cell;

constexpr const char* kChosen = "DB_20_postures";
constexpr size_t kGrasps = 3;  ///< open, pinch and power come first in that set

std::vector<Posture> pool() {
  return trajectories::movement_posture_pool(trajectories::load_gestures(trajectory_folder()));
}

std::vector<Cell> row_of(const Runs& runs, const PostureSet& set) {
  const Selection reference = select(runs, kDefaultSetting, kChosen);
  std::vector<Cell> row = {set.name, covering_radius_deg(set)};
  append(row, error_cells(select(runs, kDefaultSetting, set.name), set.name == kChosen ? nullptr : &reference));
  return row;
}

}  // namespace

PostureSet random_choice(int number) {
  PostureSet set = trajectories::posture_set(trajectory_folder(), kChosen);
  const size_t count = set.postures.size();
  set.name = fmt::format("DB_20_random_{}", number);
  set.posture_names.resize(kGrasps);
  set.postures.resize(kGrasps);
  std::vector<Posture> left = pool();
  RandomStream random(static_cast<uint64_t>(number), "database", 0, "random choice of movement postures");
  while (set.postures.size() < count) {
    const size_t index = random.index(left.size());
    set.posture_names.push_back(fmt::format("movement_{:02}", set.postures.size() - kGrasps + 1));
    set.postures.push_back(left[index]);
    left[index] = left.back();
    left.pop_back();
  }
  return set;
}

double covering_radius_deg(const PostureSet& set) {
  return degrees_from_radians(trajectories::covering_radius(pool(), set.postures));
}

Ablation posture_choice_ablation(const std::vector<PostureSet>& choices) {
  Ablation ablation{"postures", {{"low dispersion", kDefaultSetting, kChosen}}};
  for (size_t i = 0; i < choices.size(); ++i)
    ablation.rows.push_back({fmt::format("random choice {}", i + 1), kDefaultSetting, choices[i].name});
  return ablation;
}

Runs run_posture_choices(const StudyContext& context, const std::vector<PostureSet>& choices) {
  Runs runs;
  for (const PostureSet& set : choices) {
    Workbench workbench(context.workbench.config());
    workbench.database(set);
    const StudyContext own{workbench, context.options, context.store};
    const Setting setting{.name = kDefaultSetting, .tracker = context.options.tracker};
    append(runs, run_study_settings(own, {setting}, {set.name}, reports::TruthKind::source));
  }
  return runs;
}

reports::Table posture_choice_table(const Runs& runs, const std::vector<PostureSet>& choices) {
  reports::Table table = {
      "postures",
      "Choice of the movement postures",
      "DB_20_postures has 17 movement postures chosen by low-dispersion sampling from a pool; the others have 17 "
      "drawn at random from the same pool. The covering radius is the largest distance from a posture of the pool "
      "to the nearest one of the set. Errors are means over the five movements themselves, changes are against "
      "DB_20_postures with 95% intervals over blocks of frames; how much one random choice differs from the next "
      "only the rows show.",
      {{"set", "set"}, {"covering_radius_deg", "covering radius deg"}},
      1,
      {}};
  append(table.columns, error_columns());
  table.rows.push_back(row_of(runs, trajectories::posture_set(trajectory_folder(), kChosen)));
  for (const PostureSet& set : choices) table.rows.push_back(row_of(runs, set));
  return table;
}

}  // namespace glovebench::eval
