#include "core/hand/hand_file.h"

#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

constexpr std::string_view kHandFormat = "glovebench-hand";
constexpr int kHandVersion = 2;
constexpr double kMostDeviation = 1, kMostResidual_mm = 1000;
constexpr int kMostViews = 1'000'000, kMostVotes = 1'000'000;
constexpr double kMostHeight_mm = 1000 * kMostHeight;

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

std::vector<double> read_heights(const JsonCursor& json) {
  std::vector<double> heights;
  for (const JsonCursor& height_mm : json.items(kRiggedMeshVertices))
    heights.push_back(height_mm.number(-kMostHeight_mm, kMostHeight_mm) / 1000);
  return heights;
}

std::vector<PatchVotes> read_votes(const JsonCursor& json) {
  std::vector<PatchVotes> votes;
  json.expect_keys(patch_names(), {});
  for (uint8_t patch = 0; patch < kPatchCount; ++patch) {
    const JsonCursor of_patch = json[patch_names()[patch]];
    of_patch.expect_keys({"vertices", "points"});
    const JsonItems vertices = of_patch["vertices"].items();
    const JsonItems points = of_patch["points"].items(vertices.size());
    int64_t next = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
      const int64_t vertex = vertices[i].integer(0, kRiggedMeshVertices - 1);
      if (vertex < next) vertices[i].fail("vertices in ascending order");
      votes.push_back({static_cast<uint32_t>(vertex), patch, static_cast<int>(points[i].integer(1, kMostVotes))});
      next = vertex + 1;
    }
  }
  return votes;
}

nlohmann::ordered_json heights_json(const std::vector<double>& heights) {
  nlohmann::ordered_json heights_mm = nlohmann::ordered_json::array();
  for (size_t v = 0; v < kRiggedMeshVertices; ++v)
    heights_mm.push_back(heights.empty() ? 0 : rounded_to_file(1000 * heights.at(v)));
  return heights_mm;
}

nlohmann::ordered_json votes_json(const std::vector<PatchVotes>& votes) {
  nlohmann::ordered_json json;
  for (const std::string_view name : patch_names())
    json[std::string(name)] = {{"vertices", nlohmann::ordered_json::array()},
                               {"points", nlohmann::ordered_json::array()}};
  for (const PatchVotes& vote : votes) {
    nlohmann::ordered_json& of_patch = json[std::string(patch_names()[vote.patch])];
    of_patch["vertices"].push_back(vote.vertex);
    of_patch["points"].push_back(vote.points);
  }
  return json;
}

}  // namespace

MeasuredHand hand_from_json(const nlohmann::json& json, const std::string& where) {
  const JsonCursor root(json, where);
  root.expect_format(kHandFormat, kHandVersion);
  root.expect_keys({"format", "version", "side", "mesh_hash", "sizes", "heights_mm", "patch_votes", "views",
                    "residual_before_mm", "residual_mm"});
  root["mesh_hash"].expect_text(kRiggedMeshHash);
  MeasuredHand hand;
  hand.side = root["side"].one_of<Side>();
  read_sizes(root["sizes"], hand);
  hand.shape.heights = read_heights(root["heights_mm"]);
  hand.shape.patch_votes = read_votes(root["patch_votes"]);
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
          {"heights_mm", heights_json(hand.shape.heights)},
          {"patch_votes", votes_json(hand.shape.patch_votes)},
          {"views", hand.views},
          {"residual_before_mm", rounded_to_file(1000 * hand.residual_before)},
          {"residual_mm", rounded_to_file(1000 * hand.residual)}};
}

MeasuredHand parse_hand(std::string_view text, const std::string& where) {
  return hand_from_json(parse_json(text, where), where);
}

MeasuredHand load_hand(const std::string& path) { return parse_hand(read_file(path, kLargestHandFile), path); }

}  // namespace glovebench
