#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "eval/frame_formats/ros2_messages.h"

namespace glovebench::eval {
namespace {

struct RosType {
  std::string_view name;
  std::string_view definition;  ///< other types with their package
};

constexpr RosType kRosTypes[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/Image", R"(std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
)"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"sensor_msgs/RegionOfInterest", R"(uint32 x_offset
uint32 y_offset
uint32 height
uint32 width
bool do_rectify
)"},
    {"sensor_msgs/CameraInfo", R"(std_msgs/Header header
uint32 height
uint32 width
string distortion_model
float64[] d
float64[9] k
float64[9] r
float64[12] p
uint32 binning_x
uint32 binning_y
sensor_msgs/RegionOfInterest roi
)"},
    {"sensor_msgs/JointState", R"(std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
)"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker", R"(std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
visualization_msgs/UVCoordinate[] uv_coordinates
string text
visualization_msgs/MeshFile mesh_file
string mesh_resource
bool mesh_use_embedded_materials
)"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
};

std::string_view ros_text(std::string_view type) {
  const auto* const found = std::ranges::find(kRosTypes, type, &RosType::name);
  check(found != std::end(kRosTypes), "a message's type is known");
  return found->definition;
}

/// Adds the types that a definition names, and theirs.
void add_named_types(std::string_view definition, std::vector<std::string_view>& types) {
  while (!definition.empty()) {
    const std::string_view line = definition.substr(0, definition.find('\n'));
    definition.remove_prefix(line.size() + 1);
    const std::string_view type = line.substr(0, line.find_first_of(" ["));
    if (type.find('/') == std::string_view::npos || std::ranges::find(types, type) != types.end()) continue;
    types.push_back(type);
    add_named_types(ros_text(type), types);
  }
}

}  // namespace

std::string ros_definition(std::string_view type) {
  std::string text(ros_text(type));
  std::vector<std::string_view> types;
  add_named_types(ros_text(type), types);
  for (const std::string_view named_type : types)
    text.append(80, '=').append("\nMSG: ").append(named_type).append("\n").append(ros_text(named_type));
  return text;
}

}  // namespace glovebench::eval
