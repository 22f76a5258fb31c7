#pragma once

// For a test that computes the metrics in another language.

#include "core/base/math.h"
#include "core/base/random.h"
#include "reports/metrics/coverage.h"
#include "reports/metrics/example_frame.h"
#include "reports/metrics/measure_frame.h"
#include "reports/text.h"

namespace glovebench::reports {

namespace measured_example {

using Json = nlohmann::ordered_json;

inline Json row_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

inline Json joints_json(const Eigen::Isometry3d& T_camera_hand, const JointPoses& T_hand_joint) {
  Json rows = Json::array();
  for (int j = 0; j < kForearmJoint; ++j) rows.push_back(row_of(T_camera_hand * T_hand_joint[j].translation()));
  return rows;
}

inline Json vertices_json(const Eigen::Isometry3d& T_camera_hand, const PosedHand& hand) {
  return array_of(hand.vertices,
                  [&](const Eigen::Vector3f& vertex) { return row_of(T_camera_hand * vertex.cast<double>()); });
}

inline Json pose_json(const Eigen::Isometry3d& T) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back(row_of(T.linear().row(r)));
  return {{"rotation", rows}, {"translation", row_of(T.translation())}};
}

inline Json camera_json(const PinholeCamera& c) {
  return {{"width", c.width}, {"height", c.height}, {"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx}, {"cy", c.cy}};
}

/// Errors grow with `spread`. `x` moves the hand to the right, m.
struct Case {
  double spread, x;
  TrackStatus status = TrackStatus::tracked;
};
inline constexpr std::array<Case, 8> kCases = {
    {{0.5, 0}, {1, 0.1}, {2, 0.2}, {4, 0}, {12, 0}, {1, 0.34}, {1, 0.375}, {1, 0, TrackStatus::poor_match}}};

inline TrackResult estimate_of(const FrameTruth& truth, const Case& c, RandomStream& random) {
  TrackResult estimate = make_estimate();
  estimate.status = c.status;
  for (int a = 0; a < kAngleCount; ++a) estimate.posture[a] = truth.posture[a] + 0.05 * c.spread * random.normal();
  const Eigen::Vector3d axis = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  estimate.T_camera_hand = truth.T_camera_hand;
  estimate.T_camera_hand.rotate(Eigen::AngleAxisd(radians_from_degrees(3 * c.spread), axis));
  estimate.T_camera_hand.pretranslate(0.004 * c.spread * Eigen::Vector3d(random.normal(), 1, random.normal()));
  return estimate;
}

inline Json hand_json(const Eigen::Isometry3d& T_camera_hand, const JointPoses& joints, const PosedHand& hand) {
  return {{"pose", pose_json(T_camera_hand)},
          {"joints", joints_json(T_camera_hand, joints)},
          {"vertices", vertices_json(T_camera_hand, hand)}};
}

inline Json metrics_json(const FrameRecord& record) {
  Json json = Json::object();
  for (const std::string& key : frame_metric_keys()) json[key] = record[key] ? Json(*record[key]) : Json();
  return json;
}

/// A frame per case. `person`: the hand in front of the camera.
inline Json frames_json(const HandModel& tracker_hand, const HandModel& person, const RgbdCalibration& cameras,
                        std::vector<FrameErrors>& measured) {
  Json frames = Json::array();
  RandomStream random(1, "example_measured", 0, "frames");
  for (const Case& c : kCases) {
    FrameTruth truth;
    truth.posture = some_posture();
    truth.T_camera_hand = Eigen::Translation3d(c.x, 0, 0) * some_pose();
    const PosedHand shown = person.pose(truth.posture);
    truth.T_hand_joint = shown.T_hand_joint;
    truth.visible_percent = visible_percent(shown, person.triangles(), truth.T_camera_hand, cameras);
    const TrackResult estimate = estimate_of(truth, c, random);
    measured.push_back(measure_frame(static_cast<int>(measured.size()), estimate, truth, tracker_hand));
    const PosedHand estimated = tracker_hand.pose(estimate.posture);
    frames.push_back(
        {{"tracked", c.status == TrackStatus::tracked},
         {"estimated", hand_json(estimate.T_camera_hand, estimated.T_hand_joint, estimated)},
         {"true", hand_json(truth.T_camera_hand, truth.T_hand_joint, tracker_hand.pose(truth.posture))},
         {"surface", vertices_json(truth.T_camera_hand, shown)},
         {"metrics", metrics_json(measured.back().record)}});
  }
  return frames;
}

}  // namespace measured_example

/// Invented frames (m, IR camera's frame) and their metrics.
inline nlohmann::ordered_json example_measured_json(const HandModel& tracker_hand) {
  using namespace measured_example;
  HandSizes sizes = HandShape().sizes;
  sizes[kScale] = 1.05;
  sizes[kPalmBreadth] = 1.1;
  const HandModel person = tracker_hand.stretched(sizes);
  const RgbdCalibration cameras = synthetic_calibration();
  std::vector<FrameErrors> measured;
  Json json = {{"fingertips", fingertip_joints()},
               {"ir", camera_json(cameras.ir)},
               {"rgb", camera_json(cameras.rgb)},
               {"T_rgb_ir", pose_json(cameras.T_rgb_ir)},
               {"frames", frames_json(tracker_hand, person, cameras, measured)}};
  for (const Triangle& triangle : person.triangles()) json["triangles"].push_back(triangle.vertices);
  SeedRun run = {1, {}};
  std::vector<double> tips_mm;
  for (const FrameErrors& errors : measured) {
    run.frames.push_back(errors.record);
    if (errors.joint_errors_mm.empty()) continue;
    for (const int tip : fingertip_joints()) tips_mm.push_back(*errors.joint_errors_mm[tip]);
  }
  const Coverage coverage = count_coverage({run});
  json["visible"] = coverage.visible;
  json["found_share"] = *coverage.found_share();
  json["usable_share"] = *coverage.usable_share();
  json["fingertip_auc"] = *pck_curve(tips_mm, 5 * run.frames.size()).area;
  return json;
}

}  // namespace glovebench::reports
