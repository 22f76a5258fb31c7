#include "render/exr.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "render/test_exr.h"

namespace glovebench::render {
namespace {

class Exr : public testing::Test {
 protected:
  const std::string path_ = test_folder() + "/layers.exr";
};

void write_exr(const std::string& path, const FrameLayers& layers) { write_file(path, encode_exr(layers, path)); }

FrameLayers some_layers() {
  FrameLayers layers{ColorImage(16, 48), DepthImage(16, 48), LabelImage(16, 48), DepthImage(16, 48),
                     LabelImage(16, 48)};
  for (size_t i = 0; i < layers.color.size(); ++i) {
    layers.color[i] = {static_cast<uint8_t>(i), static_cast<uint8_t>(255 - i), static_cast<uint8_t>(i * 7)};
    layers.depth[i] = 0.5f + 0.001f * static_cast<float>(i);
    layers.label[i] = static_cast<uint8_t>(i % 11);
    layers.tracker_depth[i] = i % 3 ? 0.7f : 0.0f;
    layers.tracker_label[i] = static_cast<uint8_t>((i + 1) % 11);
  }
  return layers;
}

TEST_F(Exr, ReadsBackWhatWasWritten) {
  const FrameLayers written = some_layers();
  write_exr(path_, written);
  const FrameLayers read = read_exr(path_);
  EXPECT_EQ(read.color, written.color);  // every 8-bit code occurs
  EXPECT_EQ(read.depth, written.depth);
  EXPECT_EQ(read.label, written.label);
  EXPECT_EQ(read.tracker_depth, written.tracker_depth);
  EXPECT_EQ(read.tracker_label, written.tracker_label);
}

TEST_F(Exr, LeavesEmptyLayersOut) {
  FrameLayers written = some_layers();
  written.color = {};
  written.tracker_depth = {};
  written.tracker_label = {};
  write_exr(path_, written);
  const FrameLayers read = read_exr(path_);
  EXPECT_TRUE(read.color.empty());
  EXPECT_TRUE(read.tracker_depth.empty());
  EXPECT_EQ(read.label, written.label);
}

TEST_F(Exr, RefusesBadInput) {
  FrameLayers layers = some_layers();
  layers.label = LabelImage(8, 8);
  EXPECT_THROW(write_exr(path_, layers), Error);
  EXPECT_THROW(write_exr(path_, {}), Error);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace glovebench::render
