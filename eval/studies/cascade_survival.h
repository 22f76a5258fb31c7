#pragma once

#include "core/database/look_up.h"
#include "eval/studies/study.h"

namespace glovebench::eval {

/// One stage of a cascade in one database, over all frames of some movements.
struct StageSurvival {
  std::string database;
  Cascade cascade;
  size_t stage = 0;  ///< of the cascade, from 0
  int candidates_in = 0;
  int candidates_out = 0;
  Sample survived_percent;  ///< 100 if the true nearest neighbor is among what the stage keeps, else 0
};

/// How often the true nearest neighbor (TrueNeighborSearch) of a frame survives each stage of each cascade in each
/// database. The look-ups are those of the tracker, on the same device frames; nothing survives in a frame
/// in which it sees no hand. Runs on the workbench's threads.
std::vector<StageSurvival> measure_survival(const StudyContext& context, const std::vector<std::string>& databases,
                                            const std::vector<Cascade>& cascades, reports::TruthKind truth);

}  // namespace glovebench::eval
