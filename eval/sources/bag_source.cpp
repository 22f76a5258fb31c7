#include "eval/sources/ros_recording.h"

namespace glovebench::eval {

SourceKind bag_source() {
  return {"bag", "bag:FILE", "images of ROS 1", open_ros_recording};
}

}  // namespace glovebench::eval
