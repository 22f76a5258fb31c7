#pragma once

#include <vector>

#include "core/database/database.h"

namespace glovebench {

/// The fields of single entries for one query: as they are stored, or made of the labels in a low-memory database.
/// The values are the same.
class EntryFields {
 public:
  /// `query` has the size whose fields are wanted. Throws Error if that size was not loaded.
  EntryFields(const Database& database, const LabelImage& query);
  /// As `Database::fields`, but with any values for colors that the query does not have. Valid up to the next call.
  const uint8_t* of(int entry);

 private:
  const Database& database_;
  int size_;
  std::vector<uint8_t> colors_;  ///< the query's
  std::vector<uint8_t> made_;    ///< of one entry; none: fields are stored
};

}  // namespace glovebench
