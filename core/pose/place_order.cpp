#include "core/pose/place_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

namespace glovebench {
namespace {

constexpr int kBits = 6;         ///< of a cell along an axis
constexpr int kSortedBits = 11;  ///< in one pass: two passes are 3 * kBits and four bits of a label

/// Inserts two zeros between the bits.
uint32_t spread(uint32_t cell) {
  cell = (cell | cell << 8) & 0x300f;
  cell = (cell | cell << 4) & 0x30c3;
  return (cell | cell << 2) & 0x9249;
}

uint32_t cell_of(float offset, float cells_per_m) {
  const float cell = offset * cells_per_m;
  constexpr float kLast = (1 << kBits) - 1;
  return cell > 0 ? static_cast<uint32_t>(std::min(cell, kLast)) : 0;  // also what is not a number
}

}  // namespace

/// A stable sort.
void PlaceOrder::sort_by_bits(int first_bit) {
  constexpr uint32_t kMask = (1 << kSortedBits) - 1;
  std::array<uint32_t, kMask + 1> place{};  // first counts, then where the next item goes
  for (const Item& item : items_) ++place[item.key >> first_bit & kMask];
  uint32_t begin = 0;
  for (uint32_t& count : place) count = std::exchange(begin, begin + count);
  sorted_.resize(items_.size());
  for (const Item& item : items_) sorted_[place[item.key >> first_bit & kMask]++] = item;
  items_.swap(sorted_);
}

std::span<const uint32_t> PlaceOrder::operator()(std::span<const LabeledPoint> points) {
  Eigen::AlignedBox3f box;
  for (const LabeledPoint& point : points) box.extend(point.p);
  const float cells_per_m = static_cast<float>(1 << kBits) / std::max(1e-6f, box.sizes().maxCoeff());
  items_.clear();
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f offset = points[i].p - box.min();
    const uint32_t cell = spread(cell_of(offset.x(), cells_per_m)) | spread(cell_of(offset.y(), cells_per_m)) << 1 |
                          spread(cell_of(offset.z(), cells_per_m)) << 2;
    items_.push_back({static_cast<uint32_t>(points[i].label) << 3 * kBits | cell, i});
  }
  sort_by_bits(0);
  sort_by_bits(kSortedBits);
  order_.clear();
  for (const Item& item : items_) order_.push_back(item.index);
  return order_;
}

}  // namespace glovebench
