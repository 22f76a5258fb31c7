#pragma once

#include "core/database/database.h"
#include "core/database/look_up_kernels.h"

namespace glovebench {

/// Distances of low-memory entries. Makes fields color by color until an entry is too far.
class MadeDistances {
 public:
  /// Throws: Error if the query's size is not loaded.
  MadeDistances(const Database& database, const LabelImage& query);

  /// Sum over glove pixels, 1/kFieldScale px; if above `limit`, any number above it.
  uint32_t sum(int entry, uint32_t limit) const;

 private:
  struct Part {
    uint8_t color = 0;
    size_t pixels = 0;
    RowRange rows_px;
    RecycledVector<FieldChunk> chunks;
    RecycledVector<WeightedRow> bounds;  ///< sum to a lower bound
  };

  const Database& database_;
  const FieldRows& rows_;
  int size_;
  uint8_t cap_;
  QueryLabels labels_;
  RecycledVector<Part> parts_;
};

}  // namespace glovebench
