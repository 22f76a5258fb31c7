#include "eval/studies/ablation_measures.h"
#include "eval/studies/light.h"
#include "eval/studies/light_curves.h"
#include "eval/studies/posture_choices.h"

namespace glovebench::eval {

reports::StudyResult run_ablations(const StudyContext& context) {
  const std::vector<Ablation> changes = ablations();
  std::vector<Ablation> wanted = changes;
  std::ranges::move(measured_ablations(), std::back_inserter(wanted));
  AblationRuns runs(context, wanted);

  // Building a database of 20 postures takes longer than everything else that a quick reproduction does.
  std::vector<PostureSet> choices;
  for (int number = 1; number <= (context.options.quick ? 1 : 3); ++number)
    choices.push_back(random_choice(number));
  add_posture_choices(context, choices, runs);

  std::vector<Ablation> shown = changes;
  shown.push_back(posture_choice_ablation(choices));
  reports::StudyResult result{"ablations", "What the paper asserts, one change at a time", {}, {}};
  result.tables = {ablation_table(runs, shown), posture_choice_table(runs, choices), color_table(runs)};
  result.measures = lag_measures(runs);
  std::ranges::move(color_measures(runs), std::back_inserter(result.measures));
  result.measures.push_back(interpolation_measure(runs));

  for (reports::StudyResult& light : std::array{run_light(context), run_light_curves(context)}) {
    std::ranges::move(light.tables, std::back_inserter(result.tables));
    std::ranges::move(light.measures, std::back_inserter(result.measures));
  }
  return result;
}

}  // namespace glovebench::eval
