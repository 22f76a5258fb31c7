#pragma once

#include <gmock/gmock.h>

#include "core/database/database.h"
#include "render/test_hand.h"

namespace glovebench {

class BlockRenderer : public ViewRenderer {
 public:
  LabelImage render_labels(const HandModel&, const PosedHand&, const PinholeCamera& camera,
                           const Eigen::Isometry3d& T_camera_hand) override {
    LabelImage image(camera.width, camera.height);
    const Eigen::Vector3d axis = T_camera_hand.linear().col(0);
    const int left = static_cast<int>(20 + 15 * axis.x()), top = static_cast<int>(20 + 15 * axis.y());
    for (int v = top; v < top + 24; ++v) {
      for (int u = left; u < left + 18; ++u) {
        image(u, v) =
            static_cast<uint8_t>(1 + ((u / 6 + v / 6) % 2 * 3 + static_cast<int>(4 + 4 * axis.z())) % kColorCount);
      }
    }
    return image;
  }
  HandImages render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                        const Eigen::Isometry3d& T_camera_hand) override {
    return {render_labels(model, hand, camera, T_camera_hand), {}, {}};
  }
};

inline constexpr ViewConfig kSmallViews{.image_size = 64};

inline PostureSet one_posture() { return {"DB_one", {"open"}, {Posture::Zero()}}; }

inline std::unique_ptr<ViewRenderer> make_block_renderer() { return std::make_unique<BlockRenderer>(); }

inline Database small_database(DatabaseMemory memory = DatabaseMemory::normal,
                               std::span<const int> sizes = kTinySizes) {
  return Database::build(one_posture(), render::test_hand(), kSmallViews, make_block_renderer, 1, {}, sizes,
                         memory);
}

inline void expect_equal(const Database& a, const Database& b, std::span<const int> sizes = kTinySizes) {
  EXPECT_EQ(a.input_hash(), b.input_hash());
  EXPECT_EQ(a.side(), b.side());
  EXPECT_EQ(a.posture_set().name, b.posture_set().name);
  EXPECT_EQ(a.posture_set().posture_names, b.posture_set().posture_names);
  EXPECT_EQ(a.posture_set().postures, b.posture_set().postures);
  EXPECT_EQ(a.memory(), b.memory());
  ASSERT_EQ(a.entry_count(), b.entry_count());
  for (int entry = 0; entry < a.entry_count(); ++entry) {
    ASSERT_EQ(a.box_ray(entry), b.box_ray(entry)) << "entry " << entry;
    for (const int size : sizes) {
      const size_t pixels = static_cast<size_t>(size) * size;
      ASSERT_EQ(a.labels(size, entry), b.labels(size, entry)) << size << " px, entry " << entry;
      ASSERT_EQ(a.field_cap(size), b.field_cap(size));
      if (a.memory() == DatabaseMemory::low) continue;
      ASSERT_TRUE(
          std::equal(a.fields(size, entry), a.fields(size, entry) + pixels * kColorCount, b.fields(size, entry)))
          << size << " px, entry " << entry;
    }
  }
}

}  // namespace glovebench
