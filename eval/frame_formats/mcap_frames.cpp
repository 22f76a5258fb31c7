#include "core/kinect/disparity.h"
#include "eval/frame_formats/frame_format.h"
#include "eval/frame_formats/mcap_writer.h"
#include "eval/frame_formats/ros2_messages.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kColorFrame = "camera_color_optical_frame", kDepthFrame = "camera_depth_optical_frame";
constexpr RosColor kTruthColor = {0.2f, 0.8f, 0.3f, 1.0f}, kEstimateColor = {1.0f, 0.6f, 0.15f, 1.0f};

enum McapTopic : size_t {
  kStaticTransforms,
  kColorImage,
  kColorInfo,
  kDepthImage,
  kDepthInfo,
  kTruthTopic,  // pose, joints, markers
  kEstimateTopic = kTruthTopic + 3,
};

McapChannel mcap_channel(std::string topic, const std::string& package, const std::string& type) {
  return {std::move(topic), package + "/msg/" + type, ros_definition(package + "/" + type)};
}

std::vector<McapChannel> mcap_channels() {
  std::vector<McapChannel> channels = {mcap_channel("/tf_static", "tf2_msgs", "TFMessage"),
                                       mcap_channel("/camera/color/image_raw", "sensor_msgs", "Image"),
                                       mcap_channel("/camera/color/camera_info", "sensor_msgs", "CameraInfo"),
                                       mcap_channel("/camera/depth/image_rect_raw", "sensor_msgs", "Image"),
                                       mcap_channel("/camera/depth/camera_info", "sensor_msgs", "CameraInfo")};
  for (const std::string hand : {"/hand/truth", "/hand/estimate"}) {
    channels.push_back(mcap_channel(hand, "geometry_msgs", "PoseStamped"));
    channels.push_back(mcap_channel(hand + "/joints", "sensor_msgs", "JointState"));
    channels.push_back(mcap_channel(hand + "/markers", "visualization_msgs", "MarkerArray"));
  }
  return channels;
}

class McapFrames : public FrameWriter {
 public:
  explicit McapFrames(const Dataset& dataset)
      : dataset_(dataset), mcap_(dataset.folder + "/" + dataset.name + ".mcap", mcap_channels()) {}

  void add(const DatasetFrame& frame) override {
    const DeviceFrame& images = frame.images;
    const RgbdCalibration& cameras = dataset_.calibration;
    const RosHeader color{images.color_timestamp_us, kColorFrame}, depth{images.depth_timestamp_us, kDepthFrame};
    if (is_first_)
      mcap_.write(kStaticTransforms, depth.timestamp_us,
                  ros_transform(depth, kColorFrame, cameras.T_rgb_ir.inverse()));
    is_first_ = false;
    mcap_.write(kColorImage, color.timestamp_us, ros_image(color, images.color));
    mcap_.write(kColorInfo, color.timestamp_us, ros_camera_info(color, cameras.rgb));
    mcap_.write(kDepthImage, depth.timestamp_us,
                ros_depth_image(depth, depth_from_disparity(images.raw_disparity, cameras.disparity)));
    mcap_.write(kDepthInfo, depth.timestamp_us, ros_camera_info(depth, cameras.ir));
    add_hand(kTruthTopic, "truth", depth, frame.truth, frame.kinect.true_hand().T_hand_joint, kTruthColor);
    if (frame.estimate) {
      const JointPoses joints = dataset_.tracker_hand->pose(frame.estimate->posture).T_hand_joint;
      add_hand(kEstimateTopic, "estimate", depth, *frame.estimate, joints, kEstimateColor);
    } else if (has_estimate_) {  // the last one must not stay
      mcap_.write(kEstimateTopic + 2, depth.timestamp_us, ros_markers(depth, "estimate", {}, {}, kEstimateColor));
    }
    has_estimate_ = frame.estimate.has_value();
  }

  void finish() override { mcap_.finish({{"README", dataset_.readme}}); }

 private:
  void add_hand(size_t topic, std::string_view name, const RosHeader& header, const HandFrame& hand,
                const JointPoses& T_hand_joint, const RosColor& color) {
    std::vector<Eigen::Vector3d> joints;
    std::vector<RosLine> bones;
    for (int j = 0; j < kForearmJoint; ++j) {
      joints.push_back(hand.T_camera_hand * T_hand_joint[j].translation());
      const bool begins_finger = j == 1 || j % 5 == 0;
      if (j != kWristJoint) bones.push_back({joints[begins_finger ? kWristJoint : j - 1], joints[j]});
    }
    mcap_.write(topic, header.timestamp_us, ros_pose(header, hand.T_camera_hand));
    mcap_.write(topic + 1, header.timestamp_us, ros_joint_state(header, hand.posture));
    mcap_.write(topic + 2, header.timestamp_us, ros_markers(header, name, joints, bones, color));
  }

  Dataset dataset_;
  McapWriter mcap_;
  bool is_first_ = true, has_estimate_ = false;
};

}  // namespace

FrameFormat mcap_frames() {
  return {"mcap", "ROS 2 messages, for Foxglove, Lichtblick and Rerun",
          "One MCAP file of ROS 2 messages (chunks and indexes with CRCs, zstd):\n"
          "/camera/color/...   image_raw (rgb8), camera_info\n"
          "/camera/depth/...   image_rect_raw (16UC1, mm; not registered), camera_info\n"
          "/hand/truth         the hand's frame in camera_depth_optical_frame, m\n"
          "/hand/truth/joints  22 angles, rad; /hand/truth/markers: 25 joints and bones\n"
          "/hand/estimate/...  the same of the tracker, with --database; not where lost\n"
          "/tf_static          the color camera in the depth camera's frame\n",
          true, [](const Dataset& dataset) -> std::unique_ptr<FrameWriter> {
            return std::make_unique<McapFrames>(dataset);
          }};
}

}  // namespace glovebench::eval
