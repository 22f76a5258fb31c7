#include <array>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "reports/metrics/coverage.h"
#include "reports/metrics/measure_frame.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

bool is_in_image(const PinholeCamera& camera, const Eigen::Vector3d& p_camera) {
  if (p_camera.z() <= 0) return false;
  const Eigen::Vector2d uv_px = camera.project(p_camera);
  return uv_px.x() >= -0.5 && uv_px.x() < camera.width - 0.5 && uv_px.y() >= -0.5 &&
         uv_px.y() < camera.height - 0.5;
}

}  // namespace

std::map<std::string, double> coverage_rules() {
  return {{"visible_percent", kVisible_percent},
          {"volume_near_mm", kVolumeNear_mm},
          {"volume_far_mm", kVolumeFar_mm},
          {"found_position_mm", kFoundPosition_mm},
          {"found_rotation_deg", kFoundRotation_deg},
          {"usable_position_mm", kUsablePosition_mm},
          {"usable_rotation_deg", kUsableRotation_deg},
          {"usable_fingertips_mm", kUsableFingertips_mm}};
}

bool is_visible(const FrameRecord& frame) {
  return rounded(frame["visible_percent"].value_or(0)) >= kVisible_percent;
}

std::optional<bool> is_usable(const FrameRecord& frame) {
  if (!frame.is_judged) return {};
  if (frame.status != TrackStatus::tracked) return false;
  if (!frame["fingertip_error_mm"]) return {};
  const auto is_below = [&](std::string_view metric, double bound) {
    return rounded(frame[metric].value_or(0)) < bound;
  };
  return is_below("position_error_mm", kUsablePosition_mm) && is_below("rotation_error_deg", kUsableRotation_deg) &&
         is_below("fingertip_error_mm", kUsableFingertips_mm);
}

double visible_percent(const PosedHand& hand, std::span<const Triangle> triangles,
                       const Eigen::Isometry3d& T_camera_hand, const RgbdCalibration& calibration) {
  double facing = 0, visible = 0;
  for (const Triangle& triangle : triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (size_t i = 0; i < 3; ++i) p[i] = T_camera_hand * hand.vertices[triangle.vertices[i]].cast<double>();
    const Eigen::Vector3d centroid = (p[0] + p[1] + p[2]) / 3;
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);  // twice the area long
    if (normal.dot(centroid) >= 0) continue;
    facing += normal.norm();
    const double z_mm = 1000 * centroid.z();
    if (z_mm >= kVolumeNear_mm && z_mm <= kVolumeFar_mm && is_in_image(calibration.ir, centroid) &&
        is_in_image(calibration.rgb, calibration.T_rgb_ir * centroid))
      visible += normal.norm();
  }
  return facing > 0 ? 100 * visible / facing : 0;
}

std::vector<Metric> coverage_metrics() {
  using Frame = const FrameRecord&;
  using Answer = std::optional<bool>;
  // Tolerance 0, since two frames, the least effect, are more than any tolerance.
  constexpr Metric::Gate kGate = {1, 0};
  return {
      {.key = "uncovered_percent",
       .unit = "%",
       .description = "frames that are lost, or 50 mm or 30 degrees off",
       .formula = "100 (frames - covered frames) / frames",
       .place = 112,
       .gate = kGate,
       .of_record = [](Frame frame) { return frame.is_judged ? Answer(!frame.covered) : Answer(); }},
      {.key = "false_tracked_percent",
       .unit = "%",
       .description = "tracked frames that are 50 mm or 30 degrees off",
       .formula = "100 (tracked frames - covered frames) / frames",
       .place = 114,
       .gate = kGate,
       .of_record = [](Frame frame) { return frame.is_judged ? Answer(frame.false_tracked) : Answer(); }},
      {.key = "false_lost_percent",
       .unit = "%",
       .description = "lost frames in which the hand could be tracked",
       .formula = "100 (lost frames in which most of the glove is in the volume, none at the border) / frames",
       .place = 116,
       .gate = kGate,
       .of_record = [](Frame frame) -> Answer { return frame.false_lost; }},
      {.key = "unusable_percent",
       .unit = "%",
       .description = "visible frames that are lost, or 10 mm, 10 degrees or (fingertips) 20 mm off",
       .formula = "100 (visible frames - usable frames) / visible frames",
       .place = 1010,
       .gate = kGate,
       .of_record = [](Frame frame) -> Answer {
         const Answer usable = is_visible(frame) ? is_usable(frame) : Answer();
         return usable ? Answer(!*usable) : usable;
       },
       .of_column = "visible_percent"},
      {.key = "visible_percent",
       .unit = "%",
       .description = "share of the glove's camera-facing area, hidden or not, in both images and the volume",
       .formula = "100 area inside both images and 0.40 to 0.95 m from the camera / camera-facing area",
       .place = 1020,
       .of_any = [](const TrackResult&, const FrameTruth& truth) { return truth.visible_percent; }},
  };
}

}  // namespace glovebench::reports
