#include "eval/sources/ros_recording.h"

namespace glovebench::eval {

SourceKind bag_source() {
  return {.name = "bag",
          .usage = "bag:FILE",
          .description = "images of ROS 1",
          .open = open_ros_recording,
          .has_topics = true};
}

}  // namespace glovebench::eval
