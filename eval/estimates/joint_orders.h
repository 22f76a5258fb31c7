#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::eval {

/// -1: a point that our skeleton lacks.
struct NamedJoint {
  std::string name;
  int joint = -1;
};

struct JointOrder {
  std::string name;  ///< empty: unknown
  std::vector<NamedJoint> joints;

  /// Index of a joint by its name or number. Empty for another word.
  std::optional<size_t> find(std::string_view word) const;
};
std::span<const JointOrder> joint_orders();

inline constexpr uint64_t kLargestJointMap = uint64_t{1} << 16;  // bytes

/// A known order's name or a file (*.json).
/// Throws: Error.
JointOrder load_joint_order(const std::string& name_or_file);
/// Reads "glovebench-joint-map" (guides/score.md): WebXR names or null, by number or by name.
/// Throws: Error.
JointOrder parse_joint_map(std::string_view text, const std::string& where);

}  // namespace glovebench::eval
