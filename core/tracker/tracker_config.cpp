#include "core/tracker/tracker_config.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/base/registry.h"
#include "core/base/text.h"

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

/// Every field of a configuration, once: name, value, range, meaning, and the paper's words and section, if any.
/// Reading, writing and checking go through here.
template <typename Config, typename Each>
void visit_fields(Config& c, Each&& each) {
  const auto visit = [&](std::string_view field, auto& value, const auto& range, std::string_view meaning,
                         std::string_view paper = {}) {
    each(ConfigMeaning{field, meaning, paper}, value, range);
  };
  visit("registration.occlusion_tolerance_m", c.registration.occlusion_tolerance, kPositive,
        "a depth pixel gets no color if another surface is this much nearer on its color ray",
        "RGBD-mapping to the mapped image M, section III-A");
  visit("segmentation.color_space", c.segmentation.color_space, Range{}, "of the lookup table that labels colors",
        "color segmentation in the YUV color space, section III-A");
  visit("segmentation.majority_filter", c.segmentation.majority_filter, Range{},
        "each label becomes that of most of its 3 x 3 neighbors");
  visit("segmentation.surface_majority", c.segmentation.surface_majority, Range{},
        "the same, among neighbors within 2 cm of depth");
  visit("segmentation.largest_component", c.segmentation.largest_component, Range{},
        "keep the largest connected part of the cloud alone");
  visit("volume.z_min_m", c.volume.z_min, kPositive, "nearest depth of a glove point",
        "working volume, equation (1), section III-A");
  visit("volume.z_max_m", c.volume.z_max, kPositive, "farthest depth of a glove point",
        "working volume, equation (1), section III-A");
  visit("database.view_distance_m", c.views.distance, Range{0.3, 10}, "from the camera of a view to the hand",
        "camera positions on a virtual sphere, section III");
  visit("database.field_of_view_deg", c.views.field_of_view_deg, Range{1, 120},
        "of the camera that renders the views", "camera views, section III");
  visit("database.image_size_px", c.views.image_size, Range{64, 2048},
        "side of a rendered view, before it becomes tiny images", "tiny images, section III");
  visit("database.field_cap_share", c.views.field_cap_share, kShare,
        "largest distance in a distance field, as a share of the tiny image's side",
        "distance transforms by chamfering, section III-B");
  visit("detection.min_pixels", c.detection.min_pixels, Range{3, 307200},
        "fewer glove pixels mean that no hand is in view");
  visit("detection.second_hand_share", c.detection.second_hand_share, kShare,
        "a second component above this share of the largest means several hands");
  visit("detection.component_depth_step_m", c.detection.component_depth_step, kPositive,
        "neighbors farther apart in depth belong to different components");
  visit("detection.max_border_pixels", c.detection.max_border_pixels, Range{0, 307200},
        "more glove pixels at the image border mean that the hand is cut");
  visit("detection.max_border_share", c.detection.max_border_share, kPositive,
        "the same for a single finger, as a share of the square root of all glove pixels");
  visit("lookup.cascade", c.lookup.cascade, Range{},
        "stages of the search: tiny images of SIZE x SIZE, then the KEEP nearest go on; the last KEEP are "
        "interpolated",
        "multi-stage k nearest neighbor lookup, matching cascade, section III-B; the number k of neighbors and the "
        "sizes D, section IV-B");
  visit("lookup.implementation", c.lookup.implementation, Names{names_in(look_ups())},
        "how the database is searched; all give the same matches");
  visit("lookup.interpolation_epsilon_px", c.lookup.interpolation_epsilon, kPositive,
        "eps in the weight 1 / (E + eps) of a neighbor with matching error E",
        "interpolation weighted with the matching error E, section III-B");
  visit("lookup.turn_to_ray", c.lookup.turn_to_ray, Range{},
        "turn a view's rotation from the ray to its hand to the ray to the hand in the image",
        "the coarse rotation estimate is mapped to the world coordinate frame, section III-C");
  visit("lookup.max_matching_error_share", c.lookup.max_matching_error, kPositive,
        "a larger error E of the best match, as a share of the last stage's side, loses the frame",
        "matching error E, Hausdorff-like distance, equation (2), section III-B");
  visit("icp.algorithm", c.icp.algorithm, Names{names_in(alignments())},
        "how the hand is aligned with the cloud; `glovebench list alignments` describes each",
        "color-sensitive Iterative Closest Point-to-Triangle (ICP-T), quaternions, section III-C");
  visit("icp.center_visible_surface", c.icp.center_visible_surface, Range{},
        "start with the center of the visible surface at the cloud's center of gravity; false: the hand's origin",
        "center of gravity (COG), coarse pose estimate, section III-C");
  visit("icp.max_points", c.icp.max_points, Range{3, 307200},
        "largest number of cloud points that are aligned, by a uniform stride; the sub-sampling",
        "ICP-T sub-sampling, section IV-C");
  visit("icp.subsampling_factor", c.icp.subsampling_factor, Range{0, 307200},
        "align every nth point of the cloud, 0: as icp.max_points says",
        "ICP-T sub-sampling factor, section IV-C and Figure 9");
  visit("icp.implementation", c.icp.implementation, Range{},
        "of the closest-point search; both give the same points", "section III-C");
  visit("icp.max_iterations", c.icp.max_iterations, Range{1, 10000}, "after them the alignment has not converged",
        "ICP-T iterations k = 1 ... K, section III-C");
  visit("icp.convergence_share", c.icp.convergence_share, kShare,
        "stop when the mean point-to-triangle distance changes by a smaller share",
        "until the alignment error converges, section III-C");
  visit("icp.cull_each_iteration", c.icp.cull_each_iteration, Range{},
        "exclude triangles that face away before each iteration, not once before all",
        "back-face culling beforehand, section III-C");
  visit("icp.color_sensitive", c.icp.color_sensitive, Range{}, "a point's closest triangle must have its color",
        "color-sensitive closest point search, section III-C");
  visit("icp.max_residual_m", c.max_residual, kPositive,
        "a larger mean distance after the alignment loses the frame", "alignment error, section III-C");
  visit("smoothing.posture_keep", c.smoothing.posture_keep, Range{0, 0.999},
        "share of the previous posture in the reported one",
        "smoothing by interpolation with the three previous frames, section III-C; Figure 5 shows 0.75");
  visit("smoothing.pose_keep", c.smoothing.pose_keep, Range{0, 0.999},
        "the same of the pose, as slerp for the rotation",
        "smoothing by interpolation with the three previous frames, section III-C; Figure 5 shows none");
  visit("smoothing.forget_after_frames", c.smoothing.forget_after, Range{1, 1e6},
        "so many lost frames restart the smoothing");
}

template <typename Value>
void read(Value& value, const JsonCursor& json, const Range&) {
  using Limits = std::numeric_limits<int>;
  if constexpr (Named<Value>)
    value = json.one_of<Value>();
  else if constexpr (std::is_same_v<Value, bool>)
    value = json.boolean();
  else if constexpr (std::is_same_v<Value, int>)
    value = static_cast<int>(json.integer(Limits::min(), Limits::max()));
  else
    value = json.number();
}
void read(std::string& value, const JsonCursor& json, const Names& names) {
  if (!json.is_text()) json.fail(fmt::format("one of {}", fmt::join(names.known, ", ")));
  value = json.text();
}
void read(Cascade& value, const JsonCursor& json, const Range&) {
  if (!json.is_text()) json.fail("a cascade such as \"16:500,64:3\"");
  try {
    value = parse_cascade(json.text());
  } catch (const Error& e) {
    throw Error(json.place() + ": " + e.what());
  }
}

template <typename Value>
json written(const Value& value) {
  if constexpr (Named<Value> || std::is_same_v<Value, Cascade>)
    return to_string(value);
  else
    return value;
}

template <typename Value>
void check_range(std::string_view field, const Value& value, const Range& range,
                 std::vector<std::string>& problems) {
  if constexpr (!Named<Value> && !std::is_same_v<Value, bool>)
    if (!range.contains(value))
      problems.push_back(fmt::format("{}: found {}, expected {}", field, value, range.text()));
}
void check_range(std::string_view field, const std::string& value, const Names& names,
                 std::vector<std::string>& problems) {
  if (std::ranges::find(names.known, value) != names.known.end()) return;
  problems.push_back(
      fmt::format("{}: found {}, expected {}", field, quoted_excerpt(value), one_of(names.known, value)));
}
void check_range(std::string_view field, const Cascade& value, const Range&, std::vector<std::string>& problems) {
  try {
    parse_cascade(to_string(value));
  } catch (const Error& e) {
    problems.push_back(fmt::format("{}: {}", field, e.what()));
  }
}

template <typename Value>
std::string range_text(const Value&, const Range& range) {
  if constexpr (Named<Value>) return known_names<Value>();
  return std::is_same_v<Value, bool> ? "true or false" : range.text();
}
std::string range_text(const std::string&, const Names& names) {
  return fmt::format("one of {}", fmt::join(names.known, ", "));
}
std::string range_text(const Cascade&, const Range&) {
  return "SIZE:KEEP, ... with sizes of 8 to 64 that rise and numbers kept that fall, or exact:KEEP";
}

/// By the end of a name: "database.view_distance_m".
std::string unit_of(std::string_view field) {
  const std::string_view end = field.substr(field.rfind('_') + 1);
  for (const std::string_view unit : {"m", "deg", "px", "share", "frames", "pixels", "points", "iterations"})
    if (end == unit) return std::string(unit);
  return "";
}

/// Every key must be one that the fields name.
void refuse_unknown_keys(const JsonCursor& root) {
  std::vector<std::string_view> top = {"profile", "method"};
  std::map<std::string_view, std::vector<std::string_view>> sections;
  const TrackerConfig any;
  visit_fields(any, [&](const ConfigMeaning& what, const auto&, const auto&) {
    const std::vector<std::string_view> names = split(what.field, '.');
    if (sections[names[0]].empty()) top.push_back(names[0]);
    sections[names[0]].push_back(names[1]);
  });
  root.expect_keys({}, top);
  for (const auto& [section, keys] : sections)
    if (root.has(section)) root[section].expect_keys({}, keys);
}

}  // namespace

std::vector<std::string> TrackerConfig::problems() const {
  std::vector<std::string> problems;
  visit_fields(*this, [&](const ConfigMeaning& what, const auto& value, const auto& range) {
    check_range(what.field, value, range, problems);
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
  visit_fields(config, [&](const ConfigMeaning& what, auto& value, const auto& range) {
    const std::vector<std::string_view> names = split(what.field, '.');
    if (root.has(names[0]) && root[names[0]].has(names[1])) read(value, root[names[0]][names[1]], range);
  });
  const std::vector<std::string> problems = config.problems();
  if (!problems.empty()) throw Error(fmt::format("{}: {}", where, fmt::join(problems, "; ")));
  return config;
}

std::vector<ConfigField> config_fields(const TrackerConfig& config) {
  constexpr ConfigMeaning kProfile = {"profile", "a named, complete configuration, which the other fields change"};
  constexpr ConfigMeaning kMethod = {"method", "how to track; `glovebench list methods` describes each"};
  std::vector<ConfigField> fields = {
      {kProfile, "", one_of(profile_names(), ""), json(config.profile).dump()},
      {kMethod, "", fmt::format("one of {}", fmt::join(method_names(), ", ")), json(config.method).dump()}};
  visit_fields(config, [&](const ConfigMeaning& what, const auto& value, const auto& range) {
    fields.push_back({what, unit_of(what.field), range_text(value, range), written(value).dump()});
  });
  return fields;
}

json to_json(const TrackerConfig& config) {
  json j;
  j["profile"] = config.profile;
  j["method"] = config.method;
  visit_fields(config, [&](const ConfigMeaning& what, const auto& value, const auto&) {
    const std::vector<std::string_view> names = split(what.field, '.');
    j[names[0]][names[1]] = written(value);
  });
  return j;
}

}  // namespace glovebench
