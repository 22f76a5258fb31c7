#pragma once

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/database/test_database.h"
#include "core/segmentation/color_calibration.h"
#include "core/test_folder.h"
#include "core/tracker/tracker.h"
#include "render/synthetic_kinect.h"

namespace glovebench {

/// `object` must outlive the pointer.
template <typename T>
std::shared_ptr<const T> borrowed(const T& object) {
  return {&object, [](const T*) {}};
}

inline const ColorTable& test_color_table() {
  static const ColorTable table = [] {
    const std::string path = shared_test_folder() + "/colors.table";
    if (std::filesystem::exists(path)) return ColorTable::load(path);
    render::RgbdRenderer renderer(synthetic_calibration(), borrowed(render::test_hand()), {});
    ColorCalibration calibration;
    for (int view = 0; view < 16; ++view) {
      RandomStream random(1, "test colors", view, "pose");
      const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
      const Eigen::Isometry3d T_camera_hand =
          Eigen::Translation3d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.65) * q.normalized();
      const PosedHand hand = render::test_hand().pose(view % 2 == 0 ? Posture(Posture::Zero()) : power_posture());
      const ColorImage color = renderer.render(hand, T_camera_hand, {}).color;
      calibration.add_view(render::add_color_noise(color, render::kColorSigma_gray, {1, "test colors", view}),
                           renderer.render_color_labels(hand, T_camera_hand));
    }
    const ColorTable built = calibration.build();
    built.save(path);
    return built;
  }();
  return table;
}

inline Tracker make_tracker(const TrackerConfig& config = {}) {
  return Tracker(config, synthetic_calibration(), borrowed(render::test_hand()), borrowed(test_database()),
                 borrowed(test_color_table()));
}

struct Shot {
  DeviceFrame frame;
  LabelImage ir_labels;
  LabelImage rgb_labels;
};

inline Shot shoot(const Eigen::Isometry3d& T_camera_hand, const Posture& posture = Posture::Zero(),
                  const render::NoiseConfig& noise = {}) {
  static render::RgbdRenderer renderer(synthetic_calibration(), borrowed(render::test_hand()), {});
  const PosedHand hand = render::test_hand().pose(posture);
  const render::RgbdImages images = renderer.render(hand, T_camera_hand, {});
  return {render::make_device_frame(images, renderer.calibration(), 1'000'000, noise, {1, "tracker test", 0}),
          images.label, renderer.render_color_labels(hand, T_camera_hand)};
}

/// If the gloves do not overlap.
inline DeviceFrame with_second_glove(const Shot& first, const Shot& second) {
  DeviceFrame frame = first.frame;
  for (size_t i = 0; i < frame.raw_disparity.size(); ++i)
    if (second.ir_labels[i] != 0) frame.raw_disparity[i] = second.frame.raw_disparity[i];
  for (size_t i = 0; i < frame.color.size(); ++i)
    if (second.rgb_labels[i] != 0) frame.color[i] = second.frame.color[i];
  return frame;
}

struct PoseError {
  double mm = 0;
  double deg = 0;
};
inline PoseError error_of(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth) {
  return {
      1000 * (found.translation() - truth.translation()).norm(),
      degrees_from_radians(Eigen::Quaterniond(found.linear()).angularDistance(Eigen::Quaterniond(truth.linear())))};
}

}  // namespace glovebench
