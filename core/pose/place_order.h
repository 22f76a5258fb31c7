#pragma once

#include <cstdint>
#include <span>

#include "core/base/recycled_vector.h"
#include "core/cloud/labeled_cloud.h"

namespace glovebench {

/// Orders points by label (at most 15), and those of one label by place, so that points that come together lie
/// together: along Morton's curve through 64 x 64 x 64 cells around all of them. What is not finite has some place.
/// It keeps its buffers.
class PlaceOrder {
 public:
  /// Indices into `points`. Valid until the next call.
  std::span<const uint32_t> operator()(std::span<const LabeledPoint> points);

 private:
  struct Item {
    uint32_t key;  ///< the label above three times kBits of the cell
    uint32_t index;
  };
  void sort_by_bits(int first_bit);

  RecycledVector<Item> items_, sorted_;
  RecycledVector<uint32_t> order_;
};

}  // namespace glovebench
