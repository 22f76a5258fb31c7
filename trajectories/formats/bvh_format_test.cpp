#include <fmt/format.h>
#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/test_error.h"
#include "trajectories/capture/fit_hand.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using testing::HasSubstr;

constexpr int kBvhFrames = 12;

const HandModel& bvh_hand() {
  static const HandModel hand = HandModel::load(build_paths::hand_mesh());
  return hand;
}

Posture bvh_posture(int frame) {
  Posture posture = Posture::Zero();
  for (int a = kThumbCmcAbduction; a < kAngleCount; ++a)
    posture[a] = radians_from_degrees(10 + 8 * std::sin(0.5 * frame + a));
  // As tendons bend them, which the fit expects.
  for (const int dip : {kIndexDipFlexion, kMiddleDipFlexion, kRingDipFlexion, kLittleDipFlexion})
    posture[dip] = posture[dip - 1] * 2 / 3;
  return posture;
}

Eigen::Isometry3d bvh_pose(int frame) {
  return Eigen::Translation3d(0.1, 1.2 + 0.01 * frame, -0.3) *
         Eigen::AngleAxisd(0.9 + 0.05 * frame, Eigen::Vector3d(1, -2, 0.5).normalized());
}

/// How a program writes the skeleton.
struct BvhStyle {
  std::string side = "Right";
  std::string prefix = "";
  double per_metre = 100;
  std::string order = "ZXY";      ///< of the turns
  bool finger_positions = false;  ///< channels that repeat the offsets, which are wrong then
  bool tip_joints = false;        ///< "RightHandIndex4", not an end site
};

/// Our hand's joints below an arm, as a file.
class BvhWriter {
 public:
  explicit BvhWriter(const BvhStyle& style) : style_(style) {
    for (int f = 0; f < kBvhFrames; ++f) joints_.push_back(bvh_hand().skeleton().pose(bvh_posture(f)));
  }

  std::string write() {
    frames_.assign(kBvhFrames, "");
    std::string text =
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition " + turns() + "\n";
    for (int f = 0; f < kBvhFrames; ++f) {
      add_place(f, bvh_pose(f).translation());
      add_turn(f, bvh_pose(f).linear());
    }
    text += "JOINT " + style_.prefix + style_.side + "Hand\n" + node(kWristJoint, -1);
    constexpr std::array<const char*, 5> kFingers = {"Thumb", "Index", "Middle", "Ring", "Pinky"};
    for (size_t finger = 0; finger < 5; ++finger) {
      int parent = kWristJoint;
      for (int n = 1; n <= 4; ++n) {
        const int joint = fingertip_joints()[finger] - 4 + n;
        const bool is_end = n == 4 && !style_.tip_joints;
        text += is_end ? "End Site\n"
                       : fmt::format("JOINT {}{}Hand{}{}\n", style_.prefix, style_.side, kFingers[finger], n);
        text += is_end ? fmt::format("{{\nOFFSET {}\n", offset(joint, parent)) : node(joint, parent);
        parent = joint;
      }
      text += style_.tip_joints ? "End Site\n{\nOFFSET 0 0 1\n}\n}\n}\n}\n}\n" : "}\n}\n}\n}\n";
    }
    text += fmt::format("}}\n}}\nMOTION\nFrames: {}\nFrame Time: 0.01\n", kBvhFrames);
    for (const std::string& frame : frames_) text += frame + "\n";
    return text;
  }

 private:
  std::string turns() const {
    std::string names;
    for (const char axis : style_.order) names += fmt::format("{}rotation ", axis);
    return names;
  }
  Eigen::Isometry3d local(int joint, int parent, int frame) const {
    const JointPoses& joints = joints_[static_cast<size_t>(frame)];
    return parent < 0 ? joints[joint] : joints[parent].inverse() * joints[joint];
  }
  std::string offset(int joint, int parent) const {
    const Eigen::Vector3d p = style_.per_metre * local(joint, parent, 0).translation();
    return fmt::format("{:.6f} {:.6f} {:.6f}", p.x(), p.y(), p.z());
  }
  /// Without its closing brace.
  std::string node(int joint, int parent) {
    const bool has_place = style_.finger_positions;
    for (int f = 0; f < kBvhFrames; ++f) {
      if (has_place) add_place(f, local(joint, parent, f).translation());
      add_turn(f, local(joint, parent, f).linear());
    }
    return fmt::format("{{\nOFFSET {}\nCHANNELS {} {}{}\n", has_place ? "9 9 9" : offset(joint, parent),
                       has_place ? 6 : 3, has_place ? "Xposition Yposition Zposition " : "", turns());
  }
  void add_place(int frame, const Eigen::Vector3d& place) {
    for (const double value : place) frames_[frame] += fmt::format("{:.6f} ", style_.per_metre * value);
  }
  void add_turn(int frame, const Eigen::Matrix3d& turn) {
    const Eigen::Vector3d angles =
        turn.eulerAngles(style_.order[0] - 'X', style_.order[1] - 'X', style_.order[2] - 'X');
    for (const double angle : angles) frames_[frame] += fmt::format("{:.6f} ", degrees_from_radians(angle));
  }

  BvhStyle style_;
  std::vector<JointPoses> joints_;
  std::vector<std::string> frames_;
};

MarkerSequence read_bvh(const std::string& text, Side side = Side::right) {
  return find_marker_format("bvh").markers(text, side, "file.bvh");
}

TEST(BvhFormat, JointsAreWhereTheSkeletonPutsThem) {
  for (const BvhStyle& style :
       {BvhStyle{}, BvhStyle{.prefix = "mixamorig:", .per_metre = 1}, BvhStyle{.per_metre = 1000, .order = "YXZ"},
        BvhStyle{.finger_positions = true}, BvhStyle{.tip_joints = true}}) {
    const MarkerSequence sequence = read_bvh(BvhWriter(style).write());
    ASSERT_EQ(sequence.frames.size(), static_cast<size_t>(kBvhFrames));
    EXPECT_EQ(sequence.frames[3].timestamp_us, 30'000);
    for (int f = 0; f < kBvhFrames; ++f) {
      const JointPoses joints = bvh_hand().skeleton().pose(bvh_posture(f));
      for (int j = 0; j < kWebxrJointCount; ++j) {
        const Eigen::Vector3d& point = sequence.frames[f].points[j];
        if (joint_name(j).ends_with("finger-metacarpal")) {
          EXPECT_FALSE(is_seen(point)) << "BVH has no such joint";
        } else {  // written to 1e-6 degrees and units
          EXPECT_LT((point - bvh_pose(f) * joints[j].translation()).norm(), 5e-6) << joint_name(j);
        }
      }
    }
  }
}

TEST(BvhFormat, AnglesComeBack) {
  const MarkerSequence sequence = read_bvh(BvhWriter({}).write());
  const HandFit fit = fit_hand(sequence, place_markers(sequence.names, {}, bvh_hand(), "file.bvh"),
                               bvh_hand().skeleton(), "file.bvh");
  ASSERT_EQ(fit.frames.size(), static_cast<size_t>(kBvhFrames));
  for (int f = 0; f < kBvhFrames; ++f) {
    for (int a = kThumbCmcAbduction; a < kAngleCount; ++a)
      EXPECT_NEAR(degrees_from_radians(fit.frames[f].state.posture[a]), degrees_from_radians(bvh_posture(f)[a]), 1)
          << angle_infos()[a].name;
    EXPECT_LT((fit.frames[f].state.T_capture_hand.translation() - bvh_pose(f).translation()).norm(), 0.001);
  }
  EXPECT_TRUE(fit.never_shown[kWristFlexion]) << "the elbow says nothing of the hand that moves";
}

TEST(BvhFormat, OfTwoHandsTheOneThatIsAskedFor) {
  const std::string left = BvhWriter({.side = "Left"}).write();
  EXPECT_EQ(read_bvh(left, Side::left).frames.size(), static_cast<size_t>(kBvhFrames));
  EXPECT_THROW(read_bvh(left), Error);
}

std::string bvh_refusal(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  const std::string error = thrown_by([&] { read_bvh(text.replace(at, what.size(), by)); });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

TEST(BvhFormat, RefusalsNameThePlace) {
  const std::string text = BvhWriter({}).write();
  EXPECT_THAT(bvh_refusal(text, "HIERARCHY", "HIERARCHIE"),
              HasSubstr("line 1: found \"HIERARCHIE\", expected \"HIERARCHY\""));
  EXPECT_THAT(bvh_refusal(text, "RightHandMiddle1", "RightHandMitte1"),
              HasSubstr("joints: found none named RightHandMiddle1"));
  EXPECT_THAT(bvh_refusal(text, "RightHandRing1", "RightHandIndex1"), HasSubstr("found \"RightHandIndex1\" again"));
  EXPECT_THAT(bvh_refusal(text, "Zrotation", "Wrotation"),
              HasSubstr("line 5: found \"Wrotation\", expected Xposition"));
  EXPECT_THAT(bvh_refusal(text, "CHANNELS 3", "CHANNELS 7"),
              HasSubstr("found \"7\", expected a whole number from 0 to 6"));
  EXPECT_THAT(bvh_refusal(text, "End Site", "Site"), HasSubstr("found \"Site\", expected JOINT, End Site or }"));
  EXPECT_THAT(bvh_refusal(text, "MOTION", ""), HasSubstr("found \"Frames:\", expected ROOT or MOTION"));
  EXPECT_THAT(bvh_refusal(text, "Frames: 12", "Frames: 13"),
              HasSubstr("found the end of the file, expected a number"));
  EXPECT_THAT(bvh_refusal(text, "Frames: 12", "Frames: 11"),
              HasSubstr("expected the end of the file after 11 frames"));
  EXPECT_THAT(bvh_refusal(text, "Frames: 12", "Frames: 0"), HasSubstr("Frames: found 0"));
  EXPECT_THAT(bvh_refusal(text, "Frame Time: 0.01", "Frame Time: nan"), HasSubstr("found \"nan\""));
  EXPECT_THAT(bvh_refusal(text, text, ""), HasSubstr("line 1: found the end of the file"));
  EXPECT_THAT(bvh_refusal(BvhWriter({.per_metre = 39.4}).write(), "Hips", "Hips"),
              HasSubstr("expected 5 to 15 cm, in m, cm or mm"));
}

}  // namespace
}  // namespace glovebench::trajectories
