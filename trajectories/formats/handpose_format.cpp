#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "core/base/error.h"
#include "trajectories/capture/marker_places.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

/// The float at that place.
double float_at(std::string_view bytes, size_t index, const std::string& where) {
  uint32_t bits = 0;
  for (size_t b = 0; b < 4; ++b)
    bits |= static_cast<uint32_t>(static_cast<uint8_t>(bytes[4 * index + b])) << (8 * b);
  const auto value = static_cast<double>(std::bit_cast<float>(bits));
  if (!(std::abs(value) <= kMaxCoordinate)) {
    throw Error(where, fmt::format("float {}", index), fmt::format("{}", value),
                fmt::format("a number from {} to {}", -kMaxCoordinate, kMaxCoordinate));
  }
  return value;
}

/// One hand of a pose file of npm handy-work: little-endian floats, the number of joints (25), a matrix by columns
/// for each joint of the left and of the right hand (m), and two weights a joint.
MarkerSequence parse_handpose(std::string_view bytes, Side side, const std::string& where) {
  constexpr size_t joints = kWebxrJointCount, floats = 1 + 2 * 16 * joints + 2 * joints;
  if (bytes.size() != 4 * floats)
    throw Error(where, "size", fmt::format("{} bytes", bytes.size()), fmt::format("{}", 4 * floats));
  const double count = float_at(bytes, 0, where);
  if (count != static_cast<double>(joints))
    throw Error(where, "float 0", fmt::format("{}", count), fmt::format("{}, the number of joints", joints));
  MarkerSequence sequence = sequence_of_joints();
  MarkerFrame frame;
  for (size_t j = 0; j < joints; ++j) {
    const size_t matrix = 1 + 16 * (j + (side == Side::right ? joints : 0));
    constexpr size_t translation = 12;
    Eigen::Vector3d p;
    for (size_t i = 0; i < 3; ++i) p[static_cast<int>(i)] = float_at(bytes, matrix + translation + i, where);
    frame.points.push_back(p);
  }
  sequence.frames.push_back(std::move(frame));
  return sequence;
}

}  // namespace

Format handpose_format() {
  return {.name = "handpose",
          .ending = ".handpose",
          .description = "a pose of npm handy-work",
          .markers = parse_handpose};
}

}  // namespace glovebench::trajectories
