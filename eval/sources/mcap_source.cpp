#include "eval/sources/ros_recording.h"

namespace glovebench::eval {

SourceKind mcap_source() {
  return {.name = "mcap",
          .usage = "mcap:FILE",
          .description = "images of ROS 2",
          .open = open_ros_recording,
          .has_topics = true};
}

}  // namespace glovebench::eval
