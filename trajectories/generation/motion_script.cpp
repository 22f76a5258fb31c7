#include "trajectories/generation/motion_script.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/json_cursor.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"
#include "trajectories/generation/natural_variation.h"
#include "trajectories/posture_file.h"

namespace glovebench::trajectories {
namespace {

// Drift and tremor: root mean square and band. Postures keep a few degrees around the gesture, slowly changing;
// the pose wanders by millimetres and shakes by tenths of one.
constexpr double kModeDrift = 1.2;  ///< degrees RMS of each variation mode
constexpr double kWristDriftDeg = 1.0;
constexpr double kPositionDrift = 2e-3;     ///< m
constexpr double kPositionTremor = 0.2e-3;  ///< m
constexpr double kRotationDriftDeg = 1.0;
constexpr double kRotationTremorDeg = 0.1;
constexpr double kDriftLowHz = 0.05, kDriftHighHz = 0.4;
constexpr double kTremorLowHz = 2, kTremorHighHz = 5;

Posture blend_from(const JsonCursor& field, const PostureSet& gestures) {
  Posture blend = Posture::Zero();
  double total = 0;
  for (const auto& [gesture, share] : field.members()) {
    const double weight = share.number(0, 1);
    blend += weight * find_posture(gestures, gesture);
    total += weight;
  }
  if (std::abs(total - 1) > 1e-9) field.fail(fmt::format("weights with sum {}", total), "sum 1");
  return blend;
}

WristAngles wrist_from(const JsonCursor& key) {
  const auto angle = [&](const char* name, Angle index) {
    const AngleInfo& info = angle_infos()[index];
    return radians_from_degrees(key[name].number(info.min_deg, info.max_deg));
  };
  return {angle("flexion_deg", kWristFlexion), angle("abduction_deg", kWristAbduction)};
}

HandPose pose_from(const JsonCursor& key) {
  HandPose pose;
  pose.position = key["position_mm"].vector3(kMaxPositionMm) / 1000;
  const auto angle = [&](const char* name) { return radians_from_degrees(key[name].number(-180, 180)); };
  pose.rotation = hand_rotation(angle("yaw_deg"), angle("pitch_deg"), angle("roll_deg"));
  return pose;
}

/// The keys of one channel; `value_from` reads the value of one.
template <typename Value, typename ValueFrom>
std::vector<Keyframe<Value>> keys_from(const JsonCursor& field, int frame_count,
                                       std::initializer_list<std::string_view> members, ValueFrom value_from) {
  std::vector<Keyframe<Value>> keys;
  for (const JsonCursor& key : field.some_items()) {
    key.expect_keys(members);
    const int first = keys.empty() ? 0 : keys.back().frame + 1;
    const int last = keys.empty() ? 0 : frame_count - 1;
    const auto frame = static_cast<int>(key["frame"].integer(first, last));
    keys.push_back({frame, value_from(key)});
  }
  if (keys.back().frame != frame_count - 1)
    field.fail(fmt::format("the last key at frame {}", keys.back().frame), fmt::format("{}", frame_count - 1));
  return keys;
}

/// Everything that is laid over the keyframes.
class Restlessness {
 public:
  explicit Restlessness(const MotionScript& script) : random_(script.seed, script.name, 0, "restlessness") {
    for (size_t m = 0; m < variation_modes().size(); ++m) modes_.push_back(drift());
  }

  Posture posture_offset(double time_s) const {
    Posture offset = Posture::Zero();
    for (size_t m = 0; m < modes_.size(); ++m) offset += kModeDrift * modes_[m].at(time_s) * variation_modes()[m];
    offset[kWristFlexion] = radians_from_degrees(kWristDriftDeg) * wrist_[0].at(time_s);
    offset[kWristAbduction] = radians_from_degrees(kWristDriftDeg) * wrist_[1].at(time_s);
    return offset;
  }
  Eigen::Vector3d position_offset(double time_s) const {
    return kPositionDrift * at(position_drift_, time_s) + kPositionTremor * at(position_tremor_, time_s);
  }
  Eigen::Quaterniond rotation_offset(double time_s) const {
    const Eigen::Vector3d turn_deg =
        kRotationDriftDeg * at(rotation_drift_, time_s) + kRotationTremorDeg * at(rotation_tremor_, time_s);
    const double angle = radians_from_degrees(turn_deg.norm());
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn_deg.normalized()));
  }

 private:
  using Noise3 = std::array<SmoothNoise, 3>;
  SmoothNoise drift() { return {random_, kDriftLowHz, kDriftHighHz}; }
  SmoothNoise tremor() { return {random_, kTremorLowHz, kTremorHighHz}; }
  static Eigen::Vector3d at(const Noise3& noise, double time_s) {
    return {noise[0].at(time_s), noise[1].at(time_s), noise[2].at(time_s)};
  }

  RandomStream random_;
  std::vector<SmoothNoise> modes_;
  std::array<SmoothNoise, 2> wrist_ = {drift(), drift()};
  Noise3 position_drift_ = {drift(), drift(), drift()};
  Noise3 rotation_drift_ = {drift(), drift(), drift()};
  Noise3 position_tremor_ = {tremor(), tremor(), tremor()};
  Noise3 rotation_tremor_ = {tremor(), tremor(), tremor()};
};

Posture posture_at(const MotionScript& script, int frame) {
  Posture posture = value_at(script.postures, frame);
  const WristAngles wrist = value_at(script.wrist, frame);
  posture[kWristFlexion] += wrist.flexion;
  posture[kWristAbduction] += wrist.abduction;
  return posture;
}

}  // namespace

MotionScript parse_motion_script(std::string_view text, const PostureSet& gestures, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys(
      {"format", "version", "name", "description", "seed", "frame_count", "postures", "wrist", "poses"});
  root.expect_format("glovebench-motion-script", 1);

  MotionScript script;
  script.name = root["name"].name();
  script.description = root["description"].text();
  script.seed = static_cast<uint64_t>(root["seed"].integer(0, 1'000'000));
  script.frame_count = static_cast<int>(root["frame_count"].integer(2, 100'000));
  script.postures = keys_from<Posture>(root["postures"], script.frame_count, {"frame", "blend"},
                                       [&](const JsonCursor& key) { return blend_from(key["blend"], gestures); });
  script.wrist = keys_from<WristAngles>(root["wrist"], script.frame_count,
                                        {"frame", "flexion_deg", "abduction_deg"}, wrist_from);
  script.poses = keys_from<HandPose>(root["poses"], script.frame_count,
                                     {"frame", "position_mm", "yaw_deg", "pitch_deg", "roll_deg"}, pose_from);
  return script;
}

double minimum_jerk(double time) { return time * time * time * (10 + time * (-15 + time * 6)); }

WristAngles mix(const WristAngles& a, const WristAngles& b, double share) {
  return {std::lerp(a.flexion, b.flexion, share), std::lerp(a.abduction, b.abduction, share)};
}

Posture mix(const Posture& a, const Posture& b, double share) { return a + share * (b - a); }

HandPose mix(const HandPose& a, const HandPose& b, double share) {
  return {a.position + share * (b.position - a.position), a.rotation.slerp(share, b.rotation)};
}

Eigen::Quaterniond hand_rotation(double yaw, double pitch, double roll) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  // Fingers (hand -z) up in the image (camera -y), back of the hand (hand +y) to the camera (camera -z).
  const AngleAxisd rest(radians_from_degrees(-90), Vector3d::UnitX());
  return Eigen::Quaterniond(AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitX()) *
                            AngleAxisd(roll, Vector3d::UnitY()) * rest);
}

Trajectory perform(const MotionScript& script) {
  const Restlessness restlessness(script);
  Trajectory trajectory{.name = script.name, .description = script.description, .provenance = {}, .frames = {}};
  for (int f = 0; f < script.frame_count; ++f) {
    const double time_s = f / kFrameRateHz;
    const HandPose pose = value_at(script.poses, f);
    HandFrame& frame = trajectory.frames.emplace_back();
    frame.timestamp_us = std::llround(time_s * 1e6);
    frame.posture = clamp_to_limits(posture_at(script, f) + restlessness.posture_offset(time_s));
    frame.T_camera_hand.translation() = pose.position + restlessness.position_offset(time_s);
    frame.T_camera_hand.linear() = (pose.rotation * restlessness.rotation_offset(time_s)).toRotationMatrix();
  }
  return trajectory;
}

}  // namespace glovebench::trajectories
