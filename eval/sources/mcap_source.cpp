#include "eval/sources/ros_recording.h"

namespace glovebench::eval {

SourceKind mcap_source() {
  return {"mcap", "mcap:FILE", "images of ROS 2", open_ros_recording};
}

}  // namespace glovebench::eval
