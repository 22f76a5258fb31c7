#pragma once

#include <span>
#include <vector>

#include "eval/studies/study.h"

namespace glovebench::eval {

struct Figure7Setup {
  PostureSet postures;     ///< of the database
  std::vector<int> sizes;  ///< px, rising, at least two
  int queries = 500;       ///< >= 2
};
/// 500 queries against 8,316 images (the paper: about 8000) of 11 postures of DB_20_postures. `quick`: 40 queries,
/// 3 postures, four sizes.
/// Paper: Figure 7.
Figure7Setup figure7_setup(bool quick);

/// Bootstrap intervals are over queries. Threads do not change ranks.
reports::StudyResult measure_figure7(const StudyContext& context, const Figure7Setup& setup);

/// Ranks start at 1. Ties share their mean rank.
double rank_of(std::span<const float> errors, int entry);

}  // namespace glovebench::eval
