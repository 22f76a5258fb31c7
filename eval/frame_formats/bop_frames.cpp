#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/file_set.h"
#include "eval/frame_formats/color_view.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

using nlohmann::ordered_json;
using reports::rounded;

constexpr double kBopStep_mm = 0.1;
constexpr int kBopHand = 1;  // object number

/// [left, top, width, height] of the pixels that are not 0; -1 without any.
ordered_json bop_box(const LabelImage& labels) {
  int left = labels.width(), top = labels.height(), right = -1, bottom = -1;
  for (int v = 0; v < labels.height(); ++v)
    for_each_nonzero(labels, v, [&](int u) {
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = v;
    });
  if (right < 0) return {-1, -1, -1, -1};
  return {left, top, right - left + 1, bottom - top + 1};
}

ordered_json bop_info(const ColorView& view) {
  const LabelImage& visible = view.truth.label;
  int all = 0, valid = 0, seen = 0;
  for (size_t i = 0; i < visible.size(); ++i) {
    const bool is_hand = view.truth.whole_hand[i] != 0;
    all += is_hand;
    valid += is_hand && view.depth[i] > 0;
    seen += visible[i] != 0;
  }
  return {{"bbox_obj", bop_box(view.truth.whole_hand)},
          {"bbox_visib", bop_box(visible)},
          {"px_count_all", all},
          {"px_count_valid", valid},
          {"px_count_visib", seen},
          {"visib_fract", all > 0 ? rounded(static_cast<double>(seen) / all) : 0.0}};
}

ordered_json bop_pose(const Eigen::Isometry3d& T_rgb_hand) {
  ordered_json rotation = ordered_json::array(), translation = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation.push_back(rounded(T_rgb_hand.linear()(row, column)));
    translation.push_back(rounded(1000 * T_rgb_hand.translation()[row]));
  }
  return {{"cam_R_m2c", rotation}, {"cam_t_m2c", translation}, {"obj_id", kBopHand}};
}

class BopFrames : public FrameWriter {
 public:
  explicit BopFrames(const Dataset& dataset) : dataset_(dataset), files_(dataset.folder) {
    const PinholeCamera& camera = dataset.calibration.rgb;
    const ordered_json json = {{"width", camera.width},     {"height", camera.height},  {"fx", rounded(camera.fx)},
                               {"fy", rounded(camera.fy)},  {"cx", rounded(camera.cx)}, {"cy", rounded(camera.cy)},
                               {"depth_scale", kBopStep_mm}};
    files_.add("camera.json", reports::format_json(json));
    files_.add("calibration.json", calibration_text(dataset.calibration));
  }

  void add(const DatasetFrame& frame) override {
    const ColorView view = view_from_color(frame, dataset_.tracker_hand->side());
    const PinholeCamera& camera = dataset_.calibration.rgb;
    const std::string name = fmt::format("{:06}", frame.number), key = std::to_string(frame.number);
    add_image("rgb/" + name, encode_png(frame.images.color));
    add_image("depth/" + name, encode_png(depth_in_steps(view.depth, 1000 / kBopStep_mm)));
    add_image("mask/" + name + "_000000", encode_png(mask_of(view.truth.whole_hand)));
    add_image("mask_visib/" + name + "_000000", encode_png(mask_of(view.truth.label)));
    add_image("parts/" + name, encode_png(view.truth.patch));
    files_.add(kScene + "hand/" + name + ".json", view.hand_json);
    cameras_[key] = {
        {"cam_K", {rounded(camera.fx), 0, rounded(camera.cx), 0, rounded(camera.fy), rounded(camera.cy), 0, 0, 1}},
        {"depth_scale", kBopStep_mm}};
    poses_[key] = ordered_json::array({bop_pose(view.T_rgb_hand)});
    infos_[key] = ordered_json::array({bop_info(view)});
  }

  void finish() override {
    files_.add(kScene + "scene_camera.json", reports::format_json(cameras_));
    files_.add(kScene + "scene_gt.json", reports::format_json(poses_));
    files_.add(kScene + "scene_gt_info.json", reports::format_json(infos_));
    files_.commit();
  }

 private:
  inline static const std::string kScene = "test/000000/";

  void add_image(const std::string& name, const std::string& png) { files_.add(kScene + name + ".png", png); }

  Dataset dataset_;
  WholeFiles files_;
  ordered_json cameras_ = ordered_json::object(), poses_ = cameras_, infos_ = cameras_;
};

}  // namespace

FrameFormat bop_frames() {
  static const std::string conventions =
      "test/000000/       the movement, one scene of BOP\n"
      "  rgb/, depth/     color camera; depth registered to it, 0.1 mm per step\n"
      "  mask/            255: the hand, were it alone; mask_visib/: what is seen of it\n"
      "  parts/           1 to 20: the glove's patches; 0: none\n"
      "  scene_camera.json, scene_gt.json, scene_gt_info.json   as BOP defines them:\n"
      "                   mm, row-major rotations; obj_id 1 is the hand, its pose the\n"
      "                   palm's. There is no model: the hand changes its shape\n"
      "  hand/            a JSON file for each frame, see below\n"
      "camera.json        the color camera\n"
      "calibration.json   both cameras; p_rgb = T_rgb_ir p_ir\n"
      "manifest.json      size and hash (XXH3, 128 bits) of each file\n"
      "hand/NNNNNN.json\n" +
      std::string(kHandConventions);
  return {
      "bop", "like the BOP benchmark: masks, poses, joints", conventions, false,
      [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> { return std::make_unique<BopFrames>(dataset); }};
}

}  // namespace glovebench::eval
