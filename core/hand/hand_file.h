#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/hand/hand_model.h"

namespace glovebench {

/// The hand of a person, as `glovebench calibrate hand` measures it.
struct MeasuredHand {
  Side side = Side::right;
  HandShape shape;
  HandSizes deviation{};                ///< standard deviation of each size
  std::array<bool, kSizeCount> seen{};  ///< false: the recording says little of it, and it is near that of the mesh
  int views = 0;                        ///< frames that it was fitted to
  double residual_before = 0;           ///< mean distance of their points from the hand as the mesh is, m
  double residual = 0;                  ///< and as it was fitted, m
};

inline constexpr uint64_t kLargestHandFile = uint64_t{64} << 10;  // bytes

/// A versioned JSON object, of the package's mesh. Throws Error naming the field if it is not complete, of another
/// version or mesh, or has a size that no hand has.
MeasuredHand hand_from_json(const nlohmann::json& json, const std::string& where);
nlohmann::ordered_json to_json(const MeasuredHand& hand);
/// The same as text, and as a file. Throws Error.
MeasuredHand parse_hand(std::string_view text, const std::string& where);
MeasuredHand load_hand(const std::string& path);
std::string hand_text(const MeasuredHand& hand);

}  // namespace glovebench
