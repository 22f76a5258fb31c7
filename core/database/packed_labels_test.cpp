#include "core/database/packed_labels.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

TEST(PackedLabels, hold_two_pixels_a_byte) {
  LabelImage labels(3, 1);
  labels[0] = 10;
  labels[1] = 1;
  labels[2] = 7;
  std::vector<uint8_t> packed(packed_bytes(labels.size()));
  pack_labels(labels, packed);
  EXPECT_EQ(packed, (std::vector<uint8_t>{0x1a, 0x07}));
}

TEST(PackedLabels, come_back_whatever_the_size) {
  for (int width = 1; width <= 64; width += 7) {
    for (const int height : {1, 8, 23, 64}) {
      RandomStream random(1, "packed labels", width, "labels");
      LabelImage labels(width, height);
      for (uint8_t& label : labels) label = static_cast<uint8_t>(random.index(kColorCount + 1));
      std::vector<uint8_t> packed(packed_bytes(labels.size()));
      pack_labels(labels, packed);
      EXPECT_EQ(unpack_labels(packed, width, height), labels) << width << " x " << height;
    }
  }
}

TEST(PackedLabels, of_another_size_are_refused) {
  std::vector<uint8_t> packed(4);
  EXPECT_THROW(pack_labels(LabelImage(3, 3), packed), std::logic_error);
  EXPECT_THROW(unpack_labels(packed, 3, 3), std::logic_error);
}

}  // namespace
}  // namespace glovebench
