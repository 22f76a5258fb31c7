#pragma once

#include <vector>

#include "core/base/implementation.h"
#include "core/database/cascade.h"
#include "core/database/database.h"

namespace glovebench {

/// One of the k nearest database entries.
struct Match {
  int entry = 0;
  float error = 0;  ///< equation (2), px of the last cascade stage
};

/// The query as a tiny image of each size that a cascade asks for.
struct TinyImages {
  RecycledVector<LabelImage> images;  ///< one a stage
};
TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade);

/// Equation (2) over the entry's fields: the mean over the query's glove pixels of the distance to the entry's
/// nearest pixel of the same color, px. 0 for a query without glove pixels.
float distance(const Database& database, int entry, const LabelImage& query);

/// The same for every entry, one after the other.
std::vector<float> distances(const Database& database, const LabelImage& query);

/// What each stage of a cascade kept.
struct LookUpTrace {
  /// Entries, best first; one list a stage, up to the first stage whose query has no glove pixels.
  std::vector<std::vector<int>> kept;
};

/// The matching cascade of section III-B: each stage ranks what the one before it kept. Best first; equal errors by
/// entry number. Empty for a query without glove pixels. `trace`, if given, receives what each stage kept. Both
/// implementations give the same matches and the same trace: `plain` goes entry after entry as the paper describes
/// it.
RecycledVector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                              Implementation implementation = Implementation::fast, LookUpTrace* trace = nullptr);

}  // namespace glovebench
