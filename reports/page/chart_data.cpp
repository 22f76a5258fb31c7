#include <nlohmann/json.hpp>

#include "reports/page/section.h"

namespace glovebench::reports {

nlohmann::ordered_json chart_tables(const RunResult& result, const PaperNumbers& paper) {
  const NoiseSetting noise = headline_noise(result);
  nlohmann::ordered_json tables = {{"figure4", figure4_csv(result, paper, noise)}};
  const auto add_curve = [&](const std::string& name, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    if (const ExperimentResult* experiment = find_experiment(result, key))
      tables[name] = curve_csv(*experiment, curve);
  };
  add_curve("figure5", paper.figure_5);
  add_curve("figure6", paper.figure_6);
  for (const StudyResult& study : result.studies)
    for (const Table& table : study.tables) tables[table.name] = to_csv(table);
  return tables;
}

}  // namespace glovebench::reports
