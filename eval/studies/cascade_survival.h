#pragma once

#include "core/database/look_up.h"
#include "eval/studies/study.h"

namespace glovebench::eval {

/// One stage in a database, over all frames.
struct StageSurvival {
  std::string database;
  Cascade cascade;
  size_t stage = 0;  ///< from 0
  int candidates_in = 0;
  int candidates_out = 0;
  Sample survived_percent;  ///< 100 if the stage keeps the true neighbor, else 0
};

/// How often the true neighbor (TrueNeighborSearch) survives each stage. Frames without a hand count as 0.
std::vector<StageSurvival> measure_survival(const StudyContext& context, const std::vector<std::string>& databases,
                                            const std::vector<Cascade>& cascades, reports::TruthKind truth);

}  // namespace glovebench::eval
