#include "core/base/fuzz_target.h"
#include "eval/sources/ros_recording.h"

namespace glovebench {

void ros_recording_fuzz(std::string_view bytes) {
  const std::string where = "a.mcap";
  const eval::RosIndex index = eval::index_recording(bytes, {}, where);
  expect_value_or_error([&] { eval::calibration_of(index, {}, where); });
  eval::MessageReader reader(bytes, where);
  const auto image = [&](const eval::RosImages& images, size_t i) {
    return eval::parse_ros_image({reader.at(images.places[i]), images.encoding}, where);
  };
  for (size_t i = 0; i < index.depth.places.size(); ++i)
    expect_value_or_error([&] { eval::depth_of(image(index.depth, i), where); });
  for (size_t i = 0; i < index.color.places.size(); ++i)
    expect_value_or_error([&] { eval::color_of(image(index.color, i), where); });
}

}  // namespace glovebench
