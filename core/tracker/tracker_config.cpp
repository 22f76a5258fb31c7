#include "core/tracker/tracker_config.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/base/registry.h"
#include "core/base/text.h"
#include "core/tracker/config_meanings.h"

namespace glovebench {
namespace {

using nlohmann::json;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Range {
  double min;
  double max;
  bool open_below = false;  ///< min itself is not allowed

  bool contains(double x) const { return (open_below ? x > min : x >= min) && x <= max; }
  std::string text() const {
    if (max == kUnbounded) return fmt::format("{} {}", open_below ? "above" : "at least", min);
    return fmt::format("{}{}, {}]", open_below ? "(" : "[", min, max);
  }
};

constexpr Range kPositive{0, kUnbounded, true};
constexpr Range kShare{0, 1, true};

/// Of a field that names an entry of a registry.
struct Names {
  std::vector<std::string> known;
};

/// Every field of a configuration, once: section, key, value and range. Reading, writing and checking go through
/// here.
template <typename Config, typename Visit>
void visit_fields(Config& c, Visit&& visit) {
  visit("registration", "occlusion_tolerance_m", c.registration.occlusion_tolerance, kPositive);
  visit("segmentation", "color_space", c.segmentation.color_space, Range{});
  visit("segmentation", "majority_filter", c.segmentation.majority_filter, Range{});
  visit("segmentation", "surface_majority", c.segmentation.surface_majority, Range{});
  visit("segmentation", "largest_component", c.segmentation.largest_component, Range{});
  visit("volume", "z_min_m", c.volume.z_min, kPositive);
  visit("volume", "z_max_m", c.volume.z_max, kPositive);
  visit("database", "view_distance_m", c.views.distance, Range{0.3, 10});
  visit("database", "field_of_view_deg", c.views.field_of_view_deg, Range{1, 120});
  visit("database", "image_size_px", c.views.image_size, Range{64, 2048});
  visit("database", "field_cap_share", c.views.field_cap_share, kShare);
  visit("detection", "min_pixels", c.detection.min_pixels, Range{3, 307200});
  visit("detection", "second_hand_share", c.detection.second_hand_share, kShare);
  visit("detection", "component_depth_step_m", c.detection.component_depth_step, kPositive);
  visit("detection", "max_border_pixels", c.detection.max_border_pixels, Range{0, 307200});
  visit("detection", "max_border_share", c.detection.max_border_share, kPositive);
  visit("lookup", "cascade", c.lookup.cascade, Range{});
  visit("lookup", "implementation", c.lookup.implementation, Names{names_in(look_ups())});
  visit("lookup", "interpolation_epsilon_px", c.lookup.interpolation_epsilon, kPositive);
  visit("lookup", "turn_to_ray", c.lookup.turn_to_ray, Range{});
  visit("lookup", "max_matching_error_share", c.lookup.max_matching_error, kPositive);
  visit("icp", "algorithm", c.icp.algorithm, Names{names_in(alignments())});
  visit("icp", "center_visible_surface", c.icp.center_visible_surface, Range{});
  visit("icp", "max_points", c.icp.max_points, Range{3, 307200});
  visit("icp", "subsampling_factor", c.icp.subsampling_factor, Range{0, 307200});
  visit("icp", "implementation", c.icp.implementation, Range{});
  visit("icp", "max_iterations", c.icp.max_iterations, Range{1, 10000});
  visit("icp", "convergence_share", c.icp.convergence_share, kShare);
  visit("icp", "cull_each_iteration", c.icp.cull_each_iteration, Range{});
  visit("icp", "color_sensitive", c.icp.color_sensitive, Range{});
  visit("icp", "max_residual_m", c.max_residual, kPositive);
  visit("smoothing", "posture_keep", c.smoothing.posture_keep, Range{0, 0.999});
  visit("smoothing", "pose_keep", c.smoothing.pose_keep, Range{0, 0.999});
  visit("smoothing", "forget_after_frames", c.smoothing.forget_after, Range{1, 1e6});
}

void read(double& value, const JsonCursor& json) { value = json.number(); }
void read(int& value, const JsonCursor& json) {
  value = static_cast<int>(json.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}
void read(bool& value, const JsonCursor& json) { value = json.boolean(); }
template <Named Enum>
void read(Enum& value, const JsonCursor& json) {
  value = json.one_of<Enum>();
}
void read(Cascade& value, const JsonCursor& json) {
  if (!json.is_text()) json.fail("a cascade such as \"16:500,64:3\"");
  try {
    value = parse_cascade(json.text());
  } catch (const Error& e) {
    throw Error(json.place() + ": " + e.what());
  }
}

json written(double value) { return value; }
json written(int value) { return value; }
json written(bool value) { return value; }
json written(const std::string& value) { return value; }
template <Named Enum>
json written(Enum value) {
  return to_string(value);
}
json written(const Cascade& value) { return to_string(value); }

template <typename Value>
void read(Value& value, const JsonCursor& json, const Range&) {
  read(value, json);
}
void read(std::string& value, const JsonCursor& json, const Names& names) {
  if (!json.is_text()) json.fail(fmt::format("one of {}", fmt::join(names.known, ", ")));
  value = json.text();
}

template <typename Number>
void check_range(const std::string& field, Number value, const Range& range, std::vector<std::string>& problems) {
  if (range.contains(value)) return;
  problems.push_back(fmt::format("{}: found {}, expected {}", field, value, range.text()));
}
template <>
void check_range(const std::string&, bool, const Range&, std::vector<std::string>&) {}
template <Named Enum>
void check_range(const std::string&, Enum, const Range&, std::vector<std::string>&) {}
void check_range(const std::string& field, const std::string& value, const Names& names,
                 std::vector<std::string>& problems) {
  if (std::ranges::find(names.known, value) != names.known.end()) return;
  problems.push_back(
      fmt::format("{}: found {}, expected {}", field, quoted_excerpt(value), one_of(names.known, value)));
}
void check_range(const std::string& field, const Cascade& value, const Range&, std::vector<std::string>& problems) {
  try {
    parse_cascade(to_string(value));
  } catch (const Error& e) {
    problems.push_back(field + ": " + e.what());
  }
}

std::string range_text(double, const Range& range) { return range.text(); }
std::string range_text(int, const Range& range) { return range.text(); }
std::string range_text(bool, const Range&) { return "true or false"; }
template <Named Enum>
std::string range_text(Enum, const Range&) {
  return known_names<Enum>();
}
std::string range_text(const std::string&, const Names& names) {
  return fmt::format("one of {}", fmt::join(names.known, ", "));
}
std::string range_text(const Cascade&, const Range&) {
  return "SIZE:KEEP, ... with sizes of 8 to 64 that rise and numbers kept that fall, or exact:KEEP";
}

/// By the end of a key: "view_distance_m".
std::string unit_of(std::string_view key) {
  const std::string_view end = key.substr(key.rfind('_') + 1);
  for (const std::string_view unit : {"m", "deg", "px", "share", "frames", "pixels", "points", "iterations"})
    if (end == unit) return std::string(unit);
  return "";
}

/// Every key must be one that the fields name.
void refuse_unknown_keys(const JsonCursor& root) {
  std::vector<std::string_view> top = {"profile", "method"};
  std::map<std::string_view, std::vector<std::string_view>> sections;
  const TrackerConfig any;
  visit_fields(any, [&](const char* section, const char* key, const auto&, const auto&) {
    if (sections[section].empty()) top.emplace_back(section);
    sections[section].emplace_back(key);
  });
  root.expect_keys({}, top);
  for (const auto& [section, keys] : sections)
    if (root.has(section)) root[section].expect_keys({}, keys);
}

}  // namespace

std::vector<std::string> TrackerConfig::problems() const {
  std::vector<std::string> problems;
  visit_fields(*this, [&](const char* section, const char* key, const auto& value, const auto& range) {
    check_range(fmt::format("{}.{}", section, key), value, range, problems);
  });
  const std::vector<std::string> methods(method_names().begin(), method_names().end());
  if (is_program(method))
    problems.push_back(
        fmt::format("method: found {}, expected a name; only --method starts a program", quoted_excerpt(method)));
  else if (std::ranges::find(methods, method) == methods.end())
    problems.push_back(
        fmt::format("method: found {}, expected {}", quoted_excerpt(method), one_of(methods, method)));
  if (volume.z_min >= volume.z_max) {
    problems.push_back(
        fmt::format("volume.z_min_m: found {}, expected less than z_max_m = {}", volume.z_min, volume.z_max));
  }
  return problems;
}

namespace {

const std::vector<std::string>& profile_names() {
  static const std::vector<std::string> names = {"paper", "paper-literal", "recommended"};
  return names;
}

}  // namespace

TrackerConfig profile(const std::string& name) {
  if (std::ranges::count(profile_names(), name) == 0)
    throw Error("profile", "name", name, one_of(profile_names(), name));
  TrackerConfig config;
  config.profile = name;
  if (name == "paper-literal") config.smoothing.pose_keep = config.smoothing.posture_keep;
  if (name == "recommended") {
    config.method = "articulated";
    config.segmentation.surface_majority = true;
    config.lookup.cascade = parse_cascade("exact:3");
  }
  return config;
}

TrackerConfig config_from_json(const json& j, const TrackerConfig& base, const std::string& where) {
  const JsonCursor root(j, where);
  refuse_unknown_keys(root);
  TrackerConfig config = base;
  if (root.has("profile")) {
    try {
      config = profile(root["profile"].text());
    } catch (const Error& e) {
      throw Error(where + ": " + e.what());
    }
  }
  if (root.has("method")) config.method = root["method"].text();
  visit_fields(config, [&](const char* section, const char* key, auto& value, const auto& range) {
    if (root.has(section) && root[section].has(key)) read(value, root[section][key], range);
  });
  const std::vector<std::string> problems = config.problems();
  if (!problems.empty()) throw Error(fmt::format("{}: {}", where, fmt::join(problems, "; ")));
  return config;
}

std::vector<ConfigField> config_fields(const TrackerConfig& config) {
  std::vector<ConfigField> fields = {
      {config_meaning("profile"), "", one_of(profile_names(), ""), json(config.profile).dump()},
      {config_meaning("method"), "", fmt::format("one of {}", fmt::join(method_names(), ", ")),
       json(config.method).dump()}};
  visit_fields(config, [&](const char* section, const char* key, const auto& value, const auto& range) {
    fields.push_back({config_meaning(fmt::format("{}.{}", section, key)), unit_of(key), range_text(value, range),
                      written(value).dump()});
  });
  return fields;
}

json to_json(const TrackerConfig& config) {
  json j;
  j["profile"] = config.profile;
  j["method"] = config.method;
  visit_fields(config, [&](const char* section, const char* key, const auto& value, const auto&) {
    j[section][key] = written(value);
  });
  return j;
}

}  // namespace glovebench
