#include "core/database/tiny_image.h"

#include <algorithm>
#include <cstring>

#include "core/base/error.h"

namespace glovebench {
namespace {

/// Pixels of each label; padded to the width of vector registers.
using LabelVotes = Eigen::Array<uint16_t, 16, 1>;
/// Cells up to this wide have no more pixels than a vote can count.
constexpr int kMaxCell = 250;  // px

/// The pixels under the cells of one axis, relative to the square.
struct CellRange {
  int first, last;  ///< half-open
};
CellRange cell_range(int cell, int side, int size) {
  return {cell * side / size, ((cell + 1) * side + size - 1) / size};
}

/// The label with the most votes, if no more pixels have none.
template <typename Counts>
uint8_t winner(const Counts& votes, int unlabeled) {
  int best = 1;
  for (int label = 2; label <= kColorCount; ++label)
    if (votes[label] > votes[best]) best = label;
  return votes[best] > 0 && votes[best] >= unlabeled ? static_cast<uint8_t>(best) : uint8_t{0};
}

/// What lies in each pixel column of a square, over some of its rows.
struct Columns {
  explicit Columns(int side) : votes(side), labeled(side), labeled_before(side + 1) {}
  RecycledVector<LabelVotes> votes;    ///< of the labels 1..; that of 0 means nothing
  RecycledVector<uint16_t> labeled;    ///< pixels with any label
  RecycledVector<int> labeled_before;  ///< in all columns before this one
};

/// `left` to `right` lie within the columns.
void count_row(const uint8_t* pixels, int left, int right, Columns& columns) {
  LabelVotes* const votes = columns.votes.data();
  uint16_t* const labeled = columns.labeled.data();
  for (int c = left; c < right; ++c) labeled[c] = static_cast<uint16_t>(labeled[c] + (pixels[c] != 0));
  int c = left;
  for (; c + 8 <= right; c += 8) {
    uint64_t eight = 0;
    std::memcpy(&eight, pixels + c, sizeof eight);
    if (eight == 0) continue;
    for (int i = 0; i < 8; ++i) ++votes[c + i][pixels[c + i]];
  }
  for (; c < right; ++c) ++votes[c][pixels[c]];
}

/// Counts anew; what lies outside the image has no label.
void count_columns(const LabelImage& labels, const Square& square, const CellRange& rows, Columns& columns) {
  const int left = std::clamp(-square.left, 0, square.side);
  const int right = std::clamp(labels.width() - square.left, left, square.side);
  const int top = std::clamp(square.top + rows.first, 0, labels.height());
  const int bottom = std::clamp(square.top + rows.last, top, labels.height());
  std::fill(columns.votes.begin(), columns.votes.end(), LabelVotes::Zero());
  std::fill(columns.labeled.begin(), columns.labeled.end(), uint16_t{0});
  for (int v = top; v < bottom; ++v) {
    const ptrdiff_t start = static_cast<ptrdiff_t>(v) * labels.width() + square.left;
    count_row(labels.data() + start, left, right, columns);
  }
  const uint16_t* const labeled = columns.labeled.data();
  int* const before = columns.labeled_before.data();
  for (int c = 0; c < square.side; ++c) before[c + 1] = before[c] + labeled[c];
}

}  // namespace

Square bounding_square(const LabelImage& labels) {
  const int width = labels.width();
  int left = width, right = -1, top = labels.height(), bottom = -1;
  for (int v = 0; v < labels.height(); ++v) {
    const uint8_t* const row = labels.data() + static_cast<ptrdiff_t>(v) * width;
    uint8_t any = 0;
    for (int u = 0; u < width; ++u) any |= row[u];
    if (any == 0) continue;
    top = std::min(top, v);
    bottom = v;
    // Only what lies outside the box so far can widen it.
    left = static_cast<int>(std::find_if(row, row + left, [](uint8_t label) { return label != 0; }) - row);
    int last = width - 1;
    while (last > right && row[last] == 0) --last;
    right = last;
  }
  if (right < 0) return {};
  const int side = std::max(right - left, bottom - top) + 1;
  return {left - (side - (right - left + 1)) / 2, top - (side - (bottom - top + 1)) / 2, side};
}

Eigen::Vector3d square_ray(const Square& square, const PinholeCamera& camera) {
  const double u = square.left + 0.5 * (square.side - 1), v = square.top + 0.5 * (square.side - 1);
  return camera.back_project(u, v, 1.0).normalized();
}

LabelImage make_tiny_image_plain(const LabelImage& labels, const Square& square, int size) {
  LabelImage tiny(size, size);
  if (square.side == 0) return tiny;
  for (int cv = 0; cv < size; ++cv) {
    const CellRange rows = cell_range(cv, square.side, size);
    for (int cu = 0; cu < size; ++cu) {
      const CellRange columns = cell_range(cu, square.side, size);
      std::array<int, kColorCount + 1> votes{};
      for (int v = square.top + rows.first; v < square.top + rows.last; ++v)
        for (int u = square.left + columns.first; u < square.left + columns.last; ++u)
          ++votes[labels.contains(u, v) ? labels(u, v) : 0];
      tiny(cu, cv) = winner(votes, votes[0]);
    }
  }
  return tiny;
}

LabelImage make_tiny_image(const LabelImage& labels, const Square& square, int size) {
  if (square.side > kMaxCell * size) return make_tiny_image_plain(labels, square, size);
  LabelImage tiny(size, size);
  if (square.side == 0) return tiny;
  Columns columns(square.side);
  for (int cv = 0; cv < size; ++cv) {
    const CellRange rows = cell_range(cv, square.side, size);
    count_columns(labels, square, rows, columns);
    for (int cu = 0; cu < size; ++cu) {
      const CellRange range = cell_range(cu, square.side, size);
      const int labeled = columns.labeled_before[range.last] - columns.labeled_before[range.first];
      const int unlabeled = (rows.last - rows.first) * (range.last - range.first) - labeled;
      if (labeled < unlabeled) continue;
      LabelVotes votes = LabelVotes::Zero();
      const LabelVotes* const under = columns.votes.data();
      for (int c = range.first; c < range.last; ++c) votes += under[c];
      tiny(cu, cv) = winner(votes, unlabeled);
    }
  }
  return tiny;
}

void pack_labels(const LabelImage& labels, std::span<uint8_t> packed) {
  check(packed.size() == packed_bytes(labels.size()), "room for all labels");
  for (size_t i = 0; i < packed.size(); ++i) {
    const uint8_t second = 2 * i + 1 < labels.size() ? labels[2 * i + 1] : uint8_t{0};
    packed[i] = static_cast<uint8_t>(labels[2 * i] | second << 4);
  }
}

LabelImage unpack_labels(std::span<const uint8_t> packed, int width, int height) {
  LabelImage labels(width, height);
  check(packed.size() == packed_bytes(labels.size()), "all labels are there");
  const size_t pairs = labels.size() / 2;
  for (size_t i = 0; i < pairs; ++i) {
    labels[2 * i] = packed[i] & 15;
    labels[2 * i + 1] = packed[i] >> 4;
  }
  if (labels.size() % 2 != 0) labels[2 * pairs] = packed[pairs] & 15;
  return labels;
}

}  // namespace glovebench
