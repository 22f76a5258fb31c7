#include <fmt/format.h>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/file_set.h"
#include "eval/frame_formats/color_view.h"

namespace glovebench::eval {
namespace {

constexpr double kTumSteps_per_m = 5000;

std::string tum_seconds(int64_t timestamp_us) {
  return fmt::format("{}.{:06}", timestamp_us / 1'000'000, timestamp_us % 1'000'000);
}

std::string tum_pose(const std::string& seconds, const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d p = T.translation();
  return fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", seconds, p.x(), p.y(), p.z(), q.x(),
                     q.y(), q.z(), q.w());
}

class TumFrames : public FrameWriter {
 public:
  explicit TumFrames(const Dataset& dataset) : dataset_(dataset), files_(dataset.folder) {
    files_.add("calibration.json", calibration_text(dataset.calibration));
  }

  void add(const DatasetFrame& frame) override {
    const ColorView view = view_from_color(frame, dataset_.tracker_hand->side());
    const std::string time = tum_seconds(frame.truth.timestamp_us);
    const std::string rgb = fmt::format("rgb/{}.png", time), depth = fmt::format("depth/{}.png", time);
    files_.add(rgb, encode_png(frame.images.color));
    files_.add(depth, encode_png(depth_in_steps(view.depth, kTumSteps_per_m)));
    files_.add(fmt::format("mask/{}.png", time), encode_png(mask_of(view.truth.label)));
    files_.add(fmt::format("parts/{}.png", time), encode_png(view.truth.patch));
    files_.add(fmt::format("hand/{}.json", time), view.hand_json);
    rgb_ += fmt::format("{} {}\n", time, rgb);
    depth_ += fmt::format("{} {}\n", time, depth);
    associations_ += fmt::format("{0} {1} {0} {2}\n", time, rgb, depth);
    truth_ += tum_pose(time, view.T_rgb_hand);
    if (frame.estimate) estimate_ += tum_pose(time, dataset_.calibration.T_rgb_ir * frame.estimate->T_camera_hand);
  }

  void finish() override {
    files_.add("rgb.txt", "# timestamp filename\n" + rgb_);
    files_.add("depth.txt", "# timestamp filename\n" + depth_);
    files_.add("associations.txt", associations_);
    files_.add("groundtruth.txt", "# timestamp tx ty tz qx qy qz qw\n" + truth_);
    if (!estimate_.empty()) files_.add("estimate.txt", "# timestamp tx ty tz qx qy qz qw\n" + estimate_);
    if (estimate_.empty()) files_.remove("estimate.txt");
    files_.commit();
  }

 private:
  Dataset dataset_;
  WholeFiles files_;
  std::string rgb_, depth_, associations_, truth_, estimate_;
};

}  // namespace

FrameFormat tum_frames() {
  static const std::string conventions =
      "rgb/, depth/      color camera; depth registered to it, 5000 steps per m\n"
      "rgb.txt, depth.txt, associations.txt   time stamps (s) and files\n"
      "groundtruth.txt   pose of the hand in the color camera's frame (m); in the TUM\n"
      "                  RGB-D benchmark it is the camera's in the room\n"
      "estimate.txt      the same of the tracker, with --database; lost frames are left\n"
      "                  out\n"
      "mask/             255: the glove\n"
      "parts/            1 to 20: the glove's patches; 0: none\n"
      "calibration.json  both cameras; p_rgb = T_rgb_ir p_ir\n"
      "manifest.json     size and hash (XXH3, 128 bits) of each file\n"
      "hand/             a JSON file for each frame:\n" +
      std::string(kHandConventions);
  return {
      "tum", "like the TUM RGB-D benchmark, with masks and joints", conventions, true,
      [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> { return std::make_unique<TumFrames>(dataset); }};
}

}  // namespace glovebench::eval
