#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"

namespace glovebench {

/// One stage of the look-up: keep the `keep` nearest entries by images of `size` px.
struct CascadeStage {
  int size = 64;
  int keep = 3;

  friend bool operator==(const CascadeStage&, const CascadeStage&) = default;
};
using Cascade = std::vector<CascadeStage>;

/// "16:500,64:3". Throws Error if malformed or impossible (unknown size, a stage that keeps more than the one
/// before it).
Cascade parse_cascade(std::string_view text);
std::string to_string(const Cascade& cascade);

/// One of the k nearest database entries.
struct Match {
  int entry = 0;
  float error = 0;  ///< equation (2), px of the last cascade stage
};

/// The query as a tiny image of each size that a cascade asks for.
struct TinyImages {
  std::vector<LabelImage> images;  ///< one a stage
};
TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade);

/// Equation (2) over the stored fields: the mean over the query's glove pixels of the distance to the entry's
/// nearest pixel of the same color, px. 0 for a query without glove pixels.
float distance(const Database& database, int entry, const LabelImage& query);

/// The same for every entry, one after the other.
std::vector<float> distances(const Database& database, const LabelImage& query);

/// What each stage of a cascade kept.
struct LookUpTrace {
  /// Entries, best first; one list a stage, up to the first stage whose query has no glove pixels.
  std::vector<std::vector<int>> kept;
};

/// The matching cascade of section III-B, entry after entry as the paper describes it: each stage ranks what the
/// one before it kept. Best first; equal errors by entry number. Empty for a query without glove pixels. `trace`,
/// if given, receives what each stage kept.
std::vector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                           LookUpTrace* trace = nullptr);

/// A way to look up. All give the same matches and the same trace.
struct LookUpImplementation {
  std::string_view name;
  std::vector<Match> (*look_up)(const Database&, const TinyImages&, const Cascade&, LookUpTrace*);
};
/// "plain", which is `look_up`, comes first.
std::span<const LookUpImplementation> look_up_implementations();

}  // namespace glovebench
