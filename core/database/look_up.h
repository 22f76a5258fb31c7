#pragma once

#include <span>
#include <string_view>
#include <vector>

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

/// A way to search. All give the same matches and the same trace: X_look_up.cpp in core/database/look_ups defines
/// `LookUpEntry X_look_up()`.
struct LookUpEntry {
  std::string_view name;         ///< X
  std::string_view description;  ///< one line
  /// As `look_up` below.
  RecycledVector<Match> (*look_up)(const Database& database, const TinyImages& query, const Cascade& cascade,
                                   LookUpTrace* trace);
};
/// All of that folder, sorted by name.
std::span<const LookUpEntry> look_ups();

/// The matching cascade of section III-B: each stage ranks what the one before it kept. Best first; equal errors by
/// entry number. Empty for a query without glove pixels. `name`: of `look_ups`. `trace`, if given, receives what
/// each stage kept.
RecycledVector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                              std::string_view name = "fast", LookUpTrace* trace = nullptr);

}  // namespace glovebench
