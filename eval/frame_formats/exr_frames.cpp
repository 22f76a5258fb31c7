#include <fmt/format.h>

#include "core/base/file_set.h"
#include "eval/frame_formats/frame_format.h"
#include "render/exr.h"
#include "render/label_renderer.h"

namespace glovebench::eval {
namespace {

class ExrFrames : public FrameWriter {
 public:
  explicit ExrFrames(const Dataset& dataset) : dataset_(dataset), files_(dataset.folder) {}

  void add(const DatasetFrame& frame) override {
    const render::RgbdImages& truth = frame.kinect.truth();
    render::FrameLayers layers{frame.images.color, truth.depth, truth.label, {}, {}};
    if (frame.estimate) {
      const HandModel& hand = *dataset_.tracker_hand;
      const HandImages images = renderer_.render_ids(hand, hand.pose(frame.estimate->posture),
                                                     dataset_.calibration.ir, frame.estimate->T_camera_hand);
      layers.tracker_depth = images.depth;
      layers.tracker_label = images.label;
    }
    const std::string name = fmt::format("frame_{:04}.exr", frame.number);
    files_.add(name, render::encode_exr(layers, name));
  }
  void finish() override { files_.commit(); }

 private:
  Dataset dataset_;
  WholeFiles files_;
  render::LabelRenderer renderer_;
};

}  // namespace

FrameFormat exr_frames() {
  return {"exr", "color, true z and label, with --database the tracker's view",
          "frame_NNNN.exr  R G B: color camera, linear; Z: true depth of the IR camera, m;\n"
          "                label: 1 to 10, the glove's colors; tracker.Z, tracker.label: the\n"
          "                estimated hand\n",
          true, [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> {
            return std::make_unique<ExrFrames>(dataset);
          }};
}

}  // namespace glovebench::eval
