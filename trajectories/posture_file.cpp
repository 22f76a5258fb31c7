#include "trajectories/posture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/base/angles.h"
#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "core/base/whole_file.h"
#include "trajectories/angle_json.h"
#include "trajectories/json_field.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kPostureSetFormat = "glovebench-postures";
constexpr int kPostureSetVersion = 1;

void expect_headings(const std::vector<std::string_view>& headings, const std::string& where) {
  constexpr size_t column_count = kAngleCount + 1;
  if (headings.size() != column_count) {
    throw Error(where, "line 1", fmt::format("{} columns", headings.size()),
                fmt::format("{}: name and the {} angles", column_count, kAngleCount));
  }
  for (size_t c = 0; c < column_count; ++c) {
    const std::string_view expected = c == 0 ? "name" : angle_infos()[c - 1].name;
    if (headings[c] != expected) {
      throw Error(where, fmt::format("line 1, column {}", c + 1), quoted_excerpt(headings[c]), in_quotes(expected));
    }
  }
}

/// The angle in a cell, radians.
double angle_from(std::string_view cell, const AngleInfo& info, const std::string& where, size_t line) {
  return radians_from_degrees(
      number_from(cell, info.min_deg, info.max_deg, where, fmt::format("line {}, {}", line, info.name)));
}

void expect_new_name(const std::string& name, std::set<std::string>& names, const std::string& where,
                     const std::string& field) {
  if (!names.insert(name).second) throw Error(where, field, in_quotes(name) + " again", "names that differ");
}

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

PostureSet parse_postures_json(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonField root(document, where);
  root.expect_members({"format", "version", "name", "joint_order", "postures"}, {"description"});
  root.expect_format(kPostureSetFormat, kPostureSetVersion);
  expect_joint_order(root.member("joint_order"));

  PostureSet set{.name = root.member("name").name(), .posture_names = {}, .postures = {}};
  std::set<std::string> names;
  const JsonField postures = root.member("postures");
  const size_t count = postures.array_size({"name", "angles_deg"});
  set.posture_names.reserve(count);
  set.postures.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const JsonField posture = postures.element(i);
    set.posture_names.push_back(posture.member("name").name());
    expect_new_name(set.posture_names.back(), names, where, fmt::format("postures[{}].name", i));
    set.postures.push_back(angles_from(posture.member("angles_deg")));
  }
  return set;
}

PostureSet parse_postures_csv(std::string_view text, const std::string& set_name, const std::string& where) {
  if (!is_name(set_name)) throw Error(where, "file name", quoted_excerpt(set_name), kNameExpected);

  Lines lines(text);
  expect_headings(split(*lines.next(), ','), where);
  PostureSet set{.name = set_name, .posture_names = {}, .postures = {}};
  std::set<std::string> names;
  while (const std::optional<std::string_view> text_line = lines.next()) {
    if (trimmed(*text_line).empty()) continue;
    const std::vector<std::string_view> cells = split(*text_line, ',');
    const std::string line = fmt::format("line {}", lines.number());
    if (cells.size() != kAngleCount + 1) {
      throw Error(where, line, fmt::format("{} cells", cells.size()), fmt::format("{}", kAngleCount + 1));
    }
    if (!is_name(cells[0])) throw Error(where, line + ", name", quoted_excerpt(cells[0]), kNameExpected);
    set.posture_names.emplace_back(cells[0]);
    expect_new_name(set.posture_names.back(), names, where, line + ", name");
    Posture& posture = set.postures.emplace_back();
    for (int a = 0; a < kAngleCount; ++a)
      posture[a] = angle_from(cells[a + 1], angle_infos()[a], where, lines.number());
  }
  if (set.postures.empty()) throw Error(where, "postures", "none", "at least one line below the headings");
  return set;
}

PostureSet load_posture_set(const std::string& path) {
  const std::filesystem::path file(path);
  if (file.extension() == ".json") return parse_postures_json(read_file(path, kLargestFile), path);
  if (file.extension() == ".csv")
    return parse_postures_csv(read_file(path, kLargestFile), file.stem().string(), path);
  throw Error(path, "file name", quoted_excerpt(file.extension().string()), "the ending .json or .csv");
}

std::string canonical_text(const PostureSet& set) {
  check(set.posture_names.size() == set.postures.size(), "a posture set has a name for each posture");
  std::string json = canonical_json(set);
  parse_postures_json(json, "posture set " + quoted_excerpt(set.name));
  return json;
}

void write_posture_set(const PostureSet& set, const std::string& path) {
  write_file(path, canonical_text(set));
}

const Posture& find_posture(const PostureSet& set, std::string_view name) {
  const auto found = std::ranges::find(set.posture_names, name);
  if (found == set.posture_names.end()) {
    throw Error("posture set " + set.name, "posture", quoted_excerpt(name),
                fmt::format("one of {}", fmt::join(set.posture_names, ", ")));
  }
  return set.postures[static_cast<size_t>(found - set.posture_names.begin())];
}

}  // namespace glovebench::trajectories
