#include "trajectories/posture_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "trajectories/formats/format.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kPostureSetFormat = "glovebench-postures";
constexpr int kPostureSetVersion = 1;

std::string canonical_json(const PostureSet& set) {
  std::string json = fmt::format(
      "{{\n  \"format\": {},\n  \"version\": {},\n  \"name\": {},\n  \"joint_order\": {},\n  \"postures\": [\n",
      in_quotes(kPostureSetFormat), kPostureSetVersion, in_quotes(set.name), joint_order_json());
  for (size_t i = 0; i < set.postures.size(); ++i) {
    if (i > 0) json += ",\n";
    json += fmt::format("    {{\"name\": {},\n     \"angles_deg\": {}}}", in_quotes(set.posture_names[i]),
                        angles_json(set.postures[i]));
  }
  return json + "\n  ]\n}\n";
}

}  // namespace

std::string in_quotes(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string joint_order_json() {
  std::string json = "[";
  constexpr int names_per_line = 4;
  for (int a = 0; a < kAngleCount; ++a) {
    json += a == 0 ? "\n    " : a % names_per_line == 0 ? ",\n    " : ", ";
    json += in_quotes(angle_infos()[a].name);
  }
  return json + "\n  ]";
}

void expect_joint_order(const JsonCursor& field) {
  const JsonItems names = field.items(kAngleCount);
  for (int a = 0; a < kAngleCount; ++a) names[a].expect_text(angle_infos()[a].name);
}

std::string angles_json(const Posture& posture) {
  std::string json = "[";
  for (int a = 0; a < kAngleCount; ++a) {
    if (a > 0) json += ", ";
    json += fixed(degrees_from_radians(posture[a]), 3);
  }
  return json + "]";
}

Posture angles_from(const JsonCursor& field) {
  const JsonItems angles = field.items(kAngleCount);
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[a];
    posture[a] = radians_from_degrees(angles[a].number(info.min_deg, info.max_deg));
  }
  return posture;
}

void expect_new_name(const std::string& name, std::set<std::string>& names, const std::string& where,
                     const std::string& field) {
  if (!names.insert(name).second) throw Error(where, field, quoted_excerpt(name) + " again", "names that differ");
}

PostureSet parse_postures_json(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "name", "joint_order", "postures"}, {"description"});
  root.expect_format(kPostureSetFormat, kPostureSetVersion);
  expect_joint_order(root["joint_order"]);

  PostureSet set{.name = root["name"].name(), .posture_names = {}, .postures = {}};
  std::set<std::string> names;
  const JsonItems postures = root["postures"].some_items();
  // Room is made for all only when each is known to be a posture.
  for (const JsonCursor& posture : postures) posture.expect_keys({"name", "angles_deg"});
  set.posture_names.reserve(postures.size());
  set.postures.reserve(postures.size());
  for (size_t i = 0; i < postures.size(); ++i) {
    const JsonCursor posture = postures[i];
    set.posture_names.push_back(posture["name"].name());
    expect_new_name(set.posture_names.back(), names, where, fmt::format("postures[{}].name", i));
    set.postures.push_back(angles_from(posture["angles_deg"]));
  }
  return set;
}

std::string canonical_text(const PostureSet& set) {
  check(set.posture_names.size() == set.postures.size(), "a posture set has a name for each posture");
  std::string json = canonical_json(set);
  parse_postures_json(json, "posture set " + quoted_excerpt(set.name));
  return json;
}

void write_posture_set(const PostureSet& set, const std::string& path) { write_file(path, canonical_text(set)); }

const Posture& find_posture(const PostureSet& set, std::string_view name) {
  const auto found = std::ranges::find(set.posture_names, name);
  if (found == set.posture_names.end())
    throw Error("posture set " + set.name, "posture", quoted_excerpt(name), one_of(set.posture_names, name));
  return set.postures[static_cast<size_t>(found - set.posture_names.begin())];
}

Format posture_set_format() {
  return {.name = "posture_set",
          .ending = ".json",
          .description = "glovebench's own sets of postures (README.md)",
          .postures = [](std::string_view bytes, const std::string&, const std::string& where) {
            return parse_postures_json(bytes, where);
          }};
}

}  // namespace glovebench::trajectories
