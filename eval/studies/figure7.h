#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/studies/study.h"

namespace glovebench::eval {

/// What Figure 7 is measured with.
struct Figure7Setup {
  PostureSet postures;     ///< of the database
  std::vector<int> sizes;  ///< of the tiny images, px, rising, at least two
  int queries = 500;       ///< >= 2
};
/// The paper's: 500 queries against about 8000 images. The 11 postures (8,316 images) are the first 11 of
/// DB_20_postures: those of DB_open_pinch_power and eight others. `quick`: 40 queries, 3 postures, four sizes.
Figure7Setup figure7_setup(bool quick);

/// Builds the database in memory, draws the queries, and ranks all entries for each of them with images of each
/// size. The intervals are over the queries (bootstrap). The ranks do not depend on the workbench's threads.
reports::StudyResult measure_figure7(const StudyContext& context, const Figure7Setup& setup);

/// The rank of an entry by these errors, 1 is best; entries of equal error share the mean of their ranks.
double rank_of(std::span<const float> errors, int entry);

}  // namespace glovebench::eval
