#include "core/hand/hand_file.h"

#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

constexpr std::string_view kHandFormat = "glovebench-hand";
constexpr int kHandVersion = 1;
constexpr double kMostDeviation = 1, kMostShift_mm = 1000 * kMostBorderShift, kMostResidual_mm = 1000;
constexpr int kMostViews = 1'000'000;

/// The nearest number with six digits after the point.
double rounded_to_file(double value) { return std::round(value * 1e6) / 1e6; }

void read_sizes(const JsonCursor& json, MeasuredHand& hand) {
  const auto& names = hand_size_names();
  json.expect_keys(std::vector<std::string_view>(names.begin(), names.end()), {});
  for (int i = 0; i < kSizeCount; ++i) {
    const JsonCursor size = json[names[i]];
    size.expect_keys({"factor", "deviation", "seen"});
    hand.shape.sizes[i] = size["factor"].number(kLeastHandSize, kMostHandSize);
    hand.deviation[i] = size["deviation"].number(0, kMostDeviation);
    hand.seen[i] = size["seen"].boolean();
  }
}

}  // namespace

MeasuredHand hand_from_json(const nlohmann::json& json, const std::string& where) {
  const JsonCursor root(json, where);
  root.expect_format(kHandFormat, kHandVersion);
  root.expect_keys({"format", "version", "side", "mesh_hash", "sizes", "patch_border_shift_mm", "views",
                    "residual_before_mm", "residual_mm"});
  root["mesh_hash"].expect_text(kRiggedMeshHash);
  MeasuredHand hand;
  hand.side = root["side"].one_of<Side>();
  read_sizes(root["sizes"], hand);
  hand.shape.patch_border_shift = root["patch_border_shift_mm"].number(-kMostShift_mm, kMostShift_mm) / 1000;
  hand.views = static_cast<int>(root["views"].integer(1, kMostViews));
  hand.residual_before = root["residual_before_mm"].number(0, kMostResidual_mm) / 1000;
  hand.residual = root["residual_mm"].number(0, kMostResidual_mm) / 1000;
  return hand;
}

nlohmann::ordered_json to_json(const MeasuredHand& hand) {
  nlohmann::ordered_json sizes;
  for (int i = 0; i < kSizeCount; ++i)
    sizes[hand_size_names()[i]] = {{"factor", rounded_to_file(hand.shape.sizes[i])},
                                   {"deviation", rounded_to_file(hand.deviation[i])},
                                   {"seen", hand.seen[i]}};
  return {{"format", kHandFormat},
          {"version", kHandVersion},
          {"side", to_string(hand.side)},
          {"mesh_hash", kRiggedMeshHash},
          {"sizes", sizes},
          {"patch_border_shift_mm", rounded_to_file(1000 * hand.shape.patch_border_shift)},
          {"views", hand.views},
          {"residual_before_mm", rounded_to_file(1000 * hand.residual_before)},
          {"residual_mm", rounded_to_file(1000 * hand.residual)}};
}

MeasuredHand parse_hand(std::string_view text, const std::string& where) {
  return hand_from_json(parse_json(text, where), where);
}

MeasuredHand load_hand(const std::string& path) { return parse_hand(read_file(path, kLargestHandFile), path); }

std::string hand_text(const MeasuredHand& hand) { return to_json(hand).dump(2) + "\n"; }

}  // namespace glovebench
