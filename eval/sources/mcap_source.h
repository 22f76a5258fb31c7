#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/sources/mcap_reader.h"
#include "eval/sources/ros2_reader.h"

namespace glovebench::eval {

/// The topics of images. CameraInfo is `camera_info` beside them.
struct ImageTopics {
  std::string color = "/camera/color/image_raw", depth = "/camera/depth/image_rect_raw";
};
/// Reads "color=TOPIC,depth=TOPIC", each of which may be left out.
/// Throws: Error.
ImageTopics parse_image_topics(const std::string& text);

/// The images of a topic, in the order of the file.
struct McapImages {
  std::vector<int64_t> times_us;  ///< of the headers
  std::vector<McapPlace> places;
  std::string frame;                ///< of the first image
  std::optional<RosCamera> camera;  ///< first CameraInfo
};
struct McapIndex {
  McapImages color, depth;
  std::map<std::string, RosTransform> transforms;  ///< static ones, by child
};
/// Reads the whole file.
/// Throws: Error, also without images.
McapIndex index_mcap(std::string_view file, const ImageTopics& topics, const std::string& where);

/// From CameraInfo and static transforms. Depth in the color camera's frame is registered to color.
/// Throws: Error if something is missing.
RgbdCalibration calibration_of(const McapIndex& index, const ImageTopics& topics, const std::string& where);

}  // namespace glovebench::eval
