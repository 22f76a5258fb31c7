#include "eval/sources/ros_recording.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/base/mapped_memory.h"
#include "core/base/text.h"
#include "core/kinect/frame_pairer.h"
#include "eval/sources/paired_recording.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kImage = "sensor_msgs/Image", kCameraInfo = "sensor_msgs/CameraInfo",
                           kTransforms = "tf2_msgs/TFMessage";
constexpr const char* kStaticTopic = "/tf_static";
constexpr size_t kMostImages = 108'000;  ///< of a topic: an hour
constexpr size_t kMostTransforms = 4096;

std::string info_topic(const std::string& image_topic) {
  return image_topic.substr(0, image_topic.rfind('/') + 1) + "camera_info";
}

/// Sorts the messages of a file.
class RosIndexer {
 public:
  RosIndexer(const ImageTopics& topics, const std::string& where) : topics_(topics), where_(where) {}

  void add(const MessageTopic& topic, const MessagePlace& place, std::string_view message) {
    if (has_type(topic, kImage) && image_topics_.size() < kMostNamed) image_topics_.insert(topic.name);
    if (topic.name == topics_.color) add_image(index_.color, topic, place, message);
    if (topic.name == topics_.depth) add_image(index_.depth, topic, place, message);
    if (topic.name == info_topic(topics_.color)) add_camera(index_.color, topic, message);
    if (topic.name == info_topic(topics_.depth)) add_camera(index_.depth, topic, message);
    if (topic.name == kStaticTopic) add_transforms(topic, message);
  }
  RosIndex take() {
    if (index_.color.places.empty() || index_.depth.places.empty())
      throw Error(where_, "images",
                  image_topics_.empty() ? "none" : fmt::format("{}", fmt::join(image_topics_, ", ")),
                  fmt::format("{} and {}, or --topics color=TOPIC,depth=TOPIC", topics_.color, topics_.depth));
    return std::move(index_);
  }

 private:
  static constexpr size_t kMostNamed = 10;

  /// ROS 2 says "package/msg/Type".
  static bool has_type(const MessageTopic& topic, std::string_view type) {
    std::string name = topic.type;
    if (const size_t msg = name.find("/msg/"); msg != std::string::npos) name.erase(msg, 4);
    return name == type;
  }
  RosMessage message_of(const MessageTopic& topic, std::string_view type, std::string_view bytes) const {
    const bool is_cdr = topic.encoding == "cdr";
    if (!has_type(topic, type) || !(is_cdr || topic.encoding == "ros1"))
      throw Error(where_, topic.name, fmt::format("{} ({})", topic.type, topic.encoding),
                  fmt::format("{} (cdr or ros1)", type));
    return {bytes, is_cdr ? RosEncoding::cdr : RosEncoding::ros1};
  }
  void add_image(RosImages& images, const MessageTopic& topic, const MessagePlace& place, std::string_view bytes) {
    const RosMessage message = message_of(topic, kImage, bytes);
    if (images.places.size() == kMostImages)
      throw Error(where_, topic.name, fmt::format("over {} images", kMostImages), "fewer");
    const RosHead head = parse_ros_image(message, where_).head;
    if (images.places.empty()) images.frame = head.frame;
    images.encoding = message.encoding;
    images.times_us.push_back(head.timestamp_us);
    images.places.push_back(place);
  }
  void add_camera(RosImages& images, const MessageTopic& topic, std::string_view bytes) {
    const RosMessage message = message_of(topic, kCameraInfo, bytes);
    if (!images.camera) images.camera = parse_ros_camera(message, where_);
  }
  void add_transforms(const MessageTopic& topic, std::string_view bytes) {
    for (RosTransform& transform : parse_ros_transforms(message_of(topic, kTransforms, bytes), where_)) {
      std::string child = transform.child;
      index_.transforms.insert_or_assign(std::move(child), std::move(transform));
      if (index_.transforms.size() > kMostTransforms)
        throw Error(where_, topic.name, fmt::format("over {} frames", kMostTransforms), "fewer");
    }
  }

  const ImageTopics& topics_;
  const std::string& where_;
  RosIndex index_;
  std::set<std::string> image_topics_;  ///< for the message
};

struct FrameInRoot {
  std::string root;
  Eigen::Isometry3d T_root_frame = Eigen::Isometry3d::Identity();
};
FrameInRoot frame_in_root(const RosIndex& index, const std::string& frame) {
  FrameInRoot found{frame};
  for (size_t step = 0; step < index.transforms.size(); ++step) {  // at most, also around a loop
    const auto above = index.transforms.find(found.root);
    if (above == index.transforms.end()) break;
    found.T_root_frame = above->second.T_parent_child * found.T_root_frame;
    found.root = above->second.parent;
  }
  return found;
}

/// Images of a topic "...rect..." are rectified.
std::pair<PinholeCamera, LensDistortion> camera_of(const RosImages& images, const std::string& topic,
                                                   const std::string& where) {
  if (!images.camera)
    throw Error(where, info_topic(topic), "nothing", fmt::format("{}, or --calibration", kCameraInfo));
  const bool is_rectified = topic.find("rect", topic.rfind('/') + 1) != std::string::npos;
  if (is_rectified) return {images.camera->rectified, {}};
  return {images.camera->camera, images.camera->lens};
}

/// A mapped file and a reader for each kind of image.
struct RosRecording {
  explicit RosRecording(const std::string& path) : where(path), memory(MappedMemory::of_file(path)) {}

  std::string_view file() const {
    return {reinterpret_cast<const char*>(memory.bytes().data()), memory.bytes().size()};
  }
  RosImage image(MessageReader& reader, const RosImages& images, size_t index) const {
    memory.require_unchanged();
    return parse_ros_image({reader.at(images.places[index]), images.encoding}, where);
  }

  std::string where;
  MappedMemory memory;
  MessageReader color{file(), where}, depth{file(), where};
};

}  // namespace

ImageTopics parse_image_topics(const std::string& text) {
  ImageTopics topics;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin), topic = part.substr(std::min<size_t>(6, part.size()));
    if (topic.empty() || !(part.starts_with("color=") || part.starts_with("depth=")))
      throw Error("--topics", "part", quoted_excerpt(part), "color=TOPIC or depth=TOPIC");
    (part.starts_with("color=") ? topics.color : topics.depth) = topic;
    begin = end + 1;
  }
  return topics;
}

RosIndex index_recording(std::string_view file, const ImageTopics& topics, const std::string& where) {
  RosIndexer indexer(topics, where);
  format_of(file, where)
      .for_each(file, where, [&](const MessageTopic& topic, const MessagePlace& place, std::string_view message) {
        indexer.add(topic, place, message);
      });
  return indexer.take();
}

RgbdCalibration calibration_of(const RosIndex& index, const ImageTopics& topics, const std::string& where) {
  RgbdCalibration calibration;
  std::tie(calibration.ir, calibration.ir_lens) = camera_of(index.depth, topics.depth, where);
  std::tie(calibration.rgb, calibration.rgb_lens) = camera_of(index.color, topics.color, where);
  const FrameInRoot depth = frame_in_root(index, index.depth.frame),
                    color = frame_in_root(index, index.color.frame);
  if (depth.root != color.root)
    throw Error(
        where, kStaticTopic,
        fmt::format("none from {} to {}", quoted_excerpt(index.depth.frame), quoted_excerpt(index.color.frame)),
        "the pose of one camera in the other's frame, or --calibration");
  calibration.T_rgb_ir = color.T_root_frame.inverse() * depth.T_root_frame;
  return calibration_from_json(to_json(calibration), where);  // checks the numbers
}

TrackSource open_ros_recording(const std::string& path, const SourceFlags& flags, bool) {
  const ImageTopics topics = parse_image_topics(flags.topics);
  const auto recording = std::make_shared<RosRecording>(path);
  const RosIndex index = index_recording(recording->file(), topics, path);
  const RgbdCalibration calibration =
      flags.calibration.empty() ? calibration_of(index, topics, path) : load_calibration(flags.calibration);
  RecordedImages images{index.depth.times_us, index.color.times_us,
                        [recording, depth = index.depth](size_t i) {
                          return depth_of(recording->image(recording->depth, depth, i), recording->where);
                        },
                        [recording, color = index.color](size_t i) {
                          return color_of(recording->image(recording->color, color, i), recording->where);
                        }};
  return paired_source(path, calibration, std::move(images), PairingRules().max_gap_us);
}

}  // namespace glovebench::eval
