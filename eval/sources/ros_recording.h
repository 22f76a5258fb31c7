#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/sources/message_file.h"
#include "eval/sources/ros_reader.h"
#include "eval/sources/source.h"

namespace glovebench::eval {

/// CameraInfo is `camera_info` beside them.
struct ImageTopics {
  std::string color = "/camera/color/image_raw", depth = "/camera/depth/image_rect_raw";
};
/// Reads "color=TOPIC,depth=TOPIC"; both are optional.
/// Throws: Error.
ImageTopics parse_image_topics(const std::string& text);

/// The images of a topic, in the order of the file.
struct RosImages {
  RosEncoding encoding = RosEncoding::cdr;
  std::vector<int64_t> times_us;  ///< of the headers
  std::vector<MessagePlace> places;
  std::string frame;                ///< of the first image
  std::optional<RosCamera> camera;  ///< first CameraInfo
};
struct RosIndex {
  RosImages color, depth;
  std::map<std::string, RosTransform> transforms;  ///< static ones, by child
};
/// Reads the whole file.
/// Throws: Error, also without images.
RosIndex index_recording(std::string_view file, const ImageTopics& topics, const std::string& where);

/// From CameraInfo and static transforms. Depth in the color camera's frame is registered to color.
/// Throws: Error.
RgbdCalibration calibration_of(const RosIndex& index, const ImageTopics& topics, const std::string& where);

/// Throws: Error.
TrackSource open_ros_recording(const std::string& path, const SourceFlags& flags, bool quiet);

}  // namespace glovebench::eval
