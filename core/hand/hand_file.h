#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/hand/hand_model.h"

namespace glovebench {

/// A hand that `glovebench calibrate hand` measured.
struct MeasuredHand {
  Side side = Side::right;
  HandShape shape;
  HandSizes deviation{};                ///< standard deviations, if the heights are right
  std::array<bool, kSizeCount> seen{};  ///< false: near the mesh's
  int views = 0;                        ///< fitted frames
  double residual_before = 0;           ///< mean distance of points from mesh, m
  double residual = 0;                  ///< from fitted hand, m
};

inline constexpr uint64_t kLargestHandFile = uint64_t{256} << 10;  // bytes

/// Throws: Error if incomplete, of another version or mesh, or of an impossible shape.
MeasuredHand hand_from_json(const nlohmann::json& json, const std::string& where);
nlohmann::ordered_json to_json(const MeasuredHand& hand);
/// Throws: Error.
MeasuredHand parse_hand(std::string_view text, const std::string& where);
MeasuredHand load_hand(const std::string& path);

}  // namespace glovebench
