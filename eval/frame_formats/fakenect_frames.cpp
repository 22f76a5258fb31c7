#include "core/kinect/recording.h"
#include "eval/frame_formats/frame_format.h"

namespace glovebench::eval {
namespace {

class FakenectFrames : public FrameWriter {
 public:
  explicit FakenectFrames(const Dataset& dataset) : recording_(dataset.folder, dataset.calibration) {}

  void add(const DatasetFrame& frame) override { recording_.write(frame.images); }
  void finish() override { recording_.finish(); }

 private:
  RecordingWriter recording_;
};

}  // namespace

FrameFormat fakenect_frames() {
  return {"fakenect", "a recording that libfreenect's fakenect and `glovebench track` play",
          "d-*.pgm           IR camera, 11-bit disparity; m: 345.489 / (1089.41 - value)\n"
          "r-*.ppm           color camera\n"
          "INDEX.txt         the images in order of arrival\n"
          "calibration.json  both cameras; p_rgb = T_rgb_ir p_ir\n"
          "manifest.json     size and hash (XXH3, 128 bits) of each file\n",
          false, [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> {
            return std::make_unique<FakenectFrames>(dataset);
          }};
}

}  // namespace glovebench::eval
