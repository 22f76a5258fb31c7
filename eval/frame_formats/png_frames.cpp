#include <fmt/format.h>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/file_set.h"
#include "core/kinect/disparity.h"
#include "eval/frame_formats/frame_format.h"
#include "render/pictures.h"

namespace glovebench::eval {
namespace {

class PngFrames : public FrameWriter {
 public:
  explicit PngFrames(const Dataset& dataset) : files_(dataset.folder) {}

  void add(const DatasetFrame& frame) override {
    const DepthImage depth = depth_from_disparity(frame.images.raw_disparity);
    files_.add(fmt::format("color_{:04}.png", frame.number), encode_png(frame.images.color));
    files_.add(fmt::format("depth_{:04}.png", frame.number), encode_png(render::picture_of_depth(depth, 0.4, 1.8)));
  }
  void finish() override { files_.commit(); }

 private:
  WholeFiles files_;
};

}  // namespace

FrameFormat png_frames() {
  return {"png", "color and depth pictures, to look at",
          "color_NNNN.png  color camera\n"
          "depth_NNNN.png  IR camera: warm is near (0.4 m), dark is far (1.8 m)\n",
          false, [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> {
            return std::make_unique<PngFrames>(dataset);
          }};
}

}  // namespace glovebench::eval
