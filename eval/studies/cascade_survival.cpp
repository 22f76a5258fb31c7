#include "eval/studies/cascade_survival.h"

namespace glovebench::eval {

std::vector<std::vector<std::vector<StageSurvival>>> measure_survival(const StudyContext&, const Movements&,
                                                                      const std::vector<std::string>& databases,
                                                                      const std::vector<Cascade>& cascades) {
  std::vector<std::vector<std::vector<StageSurvival>>> r(databases.size());
  for (auto& d : r)
    for (const Cascade& c : cascades) d.push_back(std::vector<StageSurvival>(c.size()));
  return r;
}

}  // namespace glovebench::eval
