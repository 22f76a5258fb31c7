#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"

namespace glovebench {

/// Keeps the `keep` entries nearest by images of `size` px.
struct CascadeStage {
  int size = 64;
  int keep = 3;

  friend bool operator==(const CascadeStage&, const CascadeStage&) = default;
};
using Cascade = std::vector<CascadeStage>;

/// Reads "16:500,64:3", or "exact:3" for "64:3".
/// Throws: Error for a malformed or impossible stage.
Cascade parse_cascade(std::string_view text);
std::string to_string(const Cascade& cascade);

struct Match {
  int entry = 0;
  float error = 0;  ///< of the last stage, px; equation (2)
};

struct TinyImages {
  RecycledVector<LabelImage> images;  ///< by stage
};
TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade);

/// Mean distance of the query's glove pixels to the entry's nearest pixel of their color, px. 0 without glove
/// pixels.
/// Paper: equation (2).
float distance(const Database& database, int entry, const LabelImage& query);

std::vector<float> distances(const Database& database, const LabelImage& query);

struct LookUpTrace {
  /// best first, by stage with glove pixels
  std::vector<std::vector<int>> kept;
};

/// core/database/look_ups/X_look_up.cpp defines `LookUpEntry X_look_up()`. All give equal matches and traces.
struct LookUpEntry {
  std::string_view name;
  std::string_view description;
  RecycledVector<Match> (*look_up)(const Database& database, const TinyImages& query, const Cascade& cascade,
                                   LookUpTrace* trace);
};
/// Sorted by name.
std::span<const LookUpEntry> look_ups();

/// Each stage ranks the entries that the stage before kept: best first, equal errors by number. Empty without
/// glove pixels.
/// Throws: Error if `name` is not in `look_ups`.
/// Paper: section III-B.
RecycledVector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                              std::string_view name = "fast", LookUpTrace* trace = nullptr);

}  // namespace glovebench
