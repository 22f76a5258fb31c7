#include "core/database/packed_labels.h"

#include "core/base/check.h"

namespace glovebench {

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
