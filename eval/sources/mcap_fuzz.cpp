#include "core/base/fuzz_target.h"
#include "eval/sources/mcap_source.h"

namespace glovebench {

void mcap_fuzz(std::string_view bytes) {
  const std::string where = "a.mcap";
  const eval::McapIndex index = eval::index_mcap(bytes, {}, where);
  expect_value_or_error([&] { eval::calibration_of(index, {}, where); });
  eval::McapMessages messages(bytes, where);
  for (const eval::McapPlace& place : index.depth.places)
    expect_value_or_error([&] { eval::depth_of(eval::parse_ros_image(messages.at(place), where), where); });
  for (const eval::McapPlace& place : index.color.places)
    expect_value_or_error([&] { eval::color_of(eval::parse_ros_image(messages.at(place), where), where); });
}

}  // namespace glovebench
