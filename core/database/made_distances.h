#pragma once

#include <vector>

#include "core/database/database.h"
#include "core/database/look_up_kernels.h"

namespace glovebench {

/// Distances of single entries of a low-memory database to one query. Fields are made color by color, and no more
/// of them than it takes to see that an entry is too far: what is not made yet counts with its bound from the rows.
class MadeDistances {
 public:
  /// Throws Error if the query's size was not loaded.
  MadeDistances(const Database& database, const LabelImage& query);

  /// The sum of the entry's distances over the query's glove pixels, 1/kFieldScale px, or any number above `limit`
  /// if it is above it.
  uint32_t sum(int entry, uint32_t limit) const;

 private:
  /// What the query has of one color.
  struct Part {
    uint8_t color = 0;
    size_t pixels = 0;
    RowRange rows_px;                    ///< where they lie
    RecycledVector<FieldChunk> chunks;   ///< of a field of this color alone
    RecycledVector<WeightedRow> bounds;  ///< rows whose sum is a lower bound
  };

  const Database& database_;
  const FieldRows& rows_;
  int size_;
  uint8_t cap_;
  QueryLabels labels_;
  RecycledVector<Part> parts_;  ///< the one with the most pixels first
};

}  // namespace glovebench
