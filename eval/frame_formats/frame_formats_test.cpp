#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/file_set.h"
#include "eval/command_test.h"
#include "eval/frame_formats/color_view.h"
#include "eval/frame_formats/ros2_messages.h"
#include "render/test_hand.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RgbdCalibration shifted_cameras() {
  RgbdCalibration calibration;
  calibration.ir = {8, 6, 100, 100, 3.5, 2.5};
  calibration.rgb = calibration.ir;
  calibration.T_rgb_ir.translation().x() = 0.02;
  return calibration;
}

TEST(RegisterDepth, MovesSamplesByTheirDisparity) {
  DepthImage depth(8, 6);
  depth(2, 1) = 1.0f;  // 2 px to the right: 100 px * 0.02 m / 1 m
  depth(0, 3) = 0.5f;  // 4 px
  const DepthImage registered = register_depth(depth, shifted_cameras());
  EXPECT_FLOAT_EQ(registered(4, 1), 1.0f);
  EXPECT_FLOAT_EQ(registered(4, 3), 0.5f);
  EXPECT_EQ(std::ranges::count(registered, 0.0f), 8 * 6 - 2);
}

TEST(RegisterDepth, NearerSamplesHideOthersAndSomeLeaveTheImage) {
  DepthImage depth(8, 6);
  depth(2, 1) = 1.0f;
  depth(0, 1) = 0.5f;
  depth(7, 5) = 1.0f;
  const DepthImage registered = register_depth(depth, shifted_cameras());
  EXPECT_FLOAT_EQ(registered(4, 1), 0.5f);
  EXPECT_EQ(std::ranges::count(registered, 0.0f), 8 * 6 - 1);
}

TEST(DepthInSteps, RoundsAndDropsWhatDoesNotFit) {
  DepthImage depth(4, 1);
  depth(1, 0) = 1.00009f;
  depth(2, 0) = 13.107f;
  depth(3, 0) = 13.2f;
  const Image<uint16_t> steps = depth_in_steps(depth, 5000);
  EXPECT_EQ(std::vector<uint16_t>(steps.begin(), steps.end()), (std::vector<uint16_t>{0, 5000, 65535, 0}));
}

/// Joints of subject 1 with its back to the camera, fingers up, then turned about the image's y axis.
std::array<JointLabel, kForearmJoint> labels_of(const Posture& posture, double turn) {
  const HandFrame frame{0, posture, render::test_pose({0, 0, 0.7}, {0, turn, 0})};
  render::SyntheticKinect kinect(synthetic_calibration(), std::make_shared<const HandModel>(render::test_hand()),
                                 {frame}, {});
  kinect.next_frame();
  return label_joints(kinect.true_hand().T_hand_joint, frame.T_camera_hand, kinect.truth().depth,
                      kinect.calibration().ir);
}

TEST(LabelJoints, AllAreSeenOfAnOpenHandFromBothSides) {
  for (const double turn : {0.0, static_cast<double>(EIGEN_PI)}) {
    Posture open = Posture::Zero();
    open[kThumbCmcFlexion] = -0.5;  // beside the palm
    const auto labels = labels_of(open, turn);
    for (int j = 0; j < kForearmJoint; ++j) EXPECT_TRUE(labels[j].is_visible) << joint_name(j) << ", " << turn;
  }
}

TEST(LabelJoints, AFistHidesItsFingertipsFromBehind) {
  Posture fist = Posture::Zero();
  for (const int angle : {kIndexMcpFlexion, kMiddleMcpFlexion, kRingMcpFlexion, kLittleMcpFlexion, kIndexPipFlexion,
                          kMiddlePipFlexion, kRingPipFlexion, kLittlePipFlexion})
    fist[angle] = 1.5;
  const auto labels = labels_of(fist, 0);
  for (const char* finger : {"index-finger", "middle-finger", "ring-finger", "pinky-finger"}) {
    EXPECT_FALSE(labels[joint_index(std::string(finger) + "-tip")].is_visible) << finger;
    EXPECT_TRUE(labels[joint_index(std::string(finger) + "-phalanx-proximal")].is_visible) << finger;
  }
}

TEST(LabelJoints, NothingIsSeenBehindTheCameraOrBesideTheImage) {
  const JointPoses at_hand = render::test_hand().pose(Posture::Zero()).T_hand_joint;
  const DepthImage empty(640, 480, 1.0f);
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(0, 0, -0.7), Eigen::Vector3d(5, 0, 0.7)}) {
    const auto labels =
        label_joints(at_hand, Eigen::Isometry3d(Eigen::Translation3d(place)), empty, synthetic_calibration().ir);
    EXPECT_TRUE(std::ranges::none_of(labels, &JointLabel::is_visible));
  }
}

TEST(RosDefinition, NamesEachTypeOnceAfterTheMessage) {
  EXPECT_EQ(ros_definition("geometry_msgs/PoseStamped"),
            "std_msgs/Header header\ngeometry_msgs/Pose pose\n" + std::string(80, '=') +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + std::string(80, '=') +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + std::string(80, '=') +
                "\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n" +
                std::string(80, '=') + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" +
                std::string(80, '=') +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n");
}

class FrameFormatsLong : public CommandTest {};

TEST_F(FrameFormatsLong, EveryFormatHasAReadmeAndNoOtherSide) {
  for (const FrameFormat& format : frame_formats()) {
    const std::string folder = path(std::string(format.name));
    expect_fine(run_glovebench({"render", "--trajectory", path("left.json"), "--format", std::string(format.name),
                                "-o", folder, "--quiet"}));
    EXPECT_THAT(read_file(folder + "/README.txt"),
                AllOf(HasSubstr(fmt::format("4 frames of left, format {}", format.name)), HasSubstr("License")));
  }
  EXPECT_THAT(read_file(path("tum/hand/0.066667.json")), HasSubstr("\"side\": \"left\""));
}

TEST_F(FrameFormatsLong, EstimatesNeedAFormatThatHasThem) {
  EXPECT_THAT(refusal(run_glovebench({"render", "--trajectory", path("good.json"), "--format", "bop", "--database",
                                      "DB_open_power", "-o", path("out")})),
              HasSubstr("--database: --format: found bop, expected exr, mcap, tum"));
  expect_fine(run_glovebench({"render", "--trajectory", path("good.json"), "--format", "tum", "--database",
                              "DB_open_power", "-o", path("out"), "--quiet"}));
  const std::string estimate = FileSet(path("out")).read("estimate.txt");
  EXPECT_EQ(std::ranges::count(estimate, '\n'), kFrames + 1);
  expect_fine(run_glovebench(
      {"render", "--trajectory", path("good.json"), "--format", "tum", "-o", path("out"), "--quiet"}));
  EXPECT_FALSE(std::filesystem::exists(path("out/estimate.txt"))) << "of an older tracker";
}

}  // namespace
}  // namespace glovebench::eval
