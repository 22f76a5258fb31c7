#pragma once

#include <cstdint>
#include <span>

#include "core/base/recycled_vector.h"
#include "core/cloud/labeled_cloud.h"

namespace glovebench {

/// Orders points by label (at most 15), then along a Morton curve of 64x64x64 cells.
class PlaceOrder {
 public:
  /// Indices into `points` until the next call.
  std::span<const uint32_t> operator()(std::span<const LabeledPoint> points);

 private:
  struct Item {
    uint32_t key;
    uint32_t index;
  };
  void sort_by_bits(int first_bit);

  RecycledVector<Item> items_, sorted_;
  RecycledVector<uint32_t> order_;
};

}  // namespace glovebench
