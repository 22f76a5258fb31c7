#include "core/tracker/tracker_config.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TrackerConfig read(const json& j) { return config_from_json(j, {}, "config.json"); }

void expect_refused(const json& j, const std::vector<std::string>& said) {
  const std::string error = thrown_by([&] { read(j); });
  EXPECT_THAT(error, HasSubstr("config.json")) << j;
  for (const std::string& part : said) EXPECT_THAT(error, HasSubstr(part)) << j;
}

/// Another value of the same type that is in range whatever the field.
json changed(const json& value) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value == "yuv") return "rgb";
  if (value == "fast") return "plain";
  if (value == "horn") return "robust";
  if (value.is_string()) return "32:7";
  if (value.is_number_integer()) return value.get<int>() + 1;
  return value.get<double>() + 1e-3;
}

TEST(TrackerConfig, the_defaults_are_the_paper_profile_and_have_no_problems) {
  EXPECT_THAT(TrackerConfig{}.problems(), IsEmpty());
  EXPECT_EQ(to_json(profile("paper")), to_json(TrackerConfig{}));
  EXPECT_EQ(TrackerConfig{}.profile, "paper");
  EXPECT_THAT([] { profile("fast"); }, ThrowsMessage<Error>(AllOf(HasSubstr("fast"), HasSubstr("paper"))));
}

TEST(TrackerConfig, the_literal_profile_filters_the_pose_like_the_posture) {
  const TrackerConfig literal = profile("paper-literal");
  EXPECT_EQ(literal.profile, "paper-literal");
  EXPECT_EQ(literal.smoothing.pose_keep, 0.75);
  json changed = to_json(literal);
  changed["profile"] = "paper";
  changed["smoothing"]["pose_keep"] = 0.0;
  EXPECT_EQ(changed, to_json(profile("paper"))) << "and nothing else";
}

TEST(TrackerConfig, the_recommended_profile_fits_all_angles_to_cleaned_labels) {
  const TrackerConfig recommended = profile("recommended");
  EXPECT_THAT(recommended.problems(), IsEmpty());
  EXPECT_EQ(recommended.method, "articulated");
  EXPECT_TRUE(recommended.segmentation.surface_majority);
  EXPECT_EQ(read(to_json(recommended)).profile, "recommended");
}

TEST(TrackerConfig, comes_back_from_json) {
  TrackerConfig config;
  config.volume.z_min = 0.123456789012345678;
  config.lookup.cascade = {{8, 700}, {32, 5}};
  config.segmentation.majority_filter = true;
  config.icp.max_iterations = 7;
  config.method = "monocular_bbox";
  const json written = to_json(config);
  const TrackerConfig back = read(json::parse(written.dump()));
  EXPECT_EQ(to_json(back), written);
  EXPECT_EQ(back.volume.z_min, config.volume.z_min);
  EXPECT_EQ(back.lookup.cascade, config.lookup.cascade);
  EXPECT_TRUE(back.segmentation.majority_filter);
  EXPECT_EQ(back.icp.max_iterations, 7);
  EXPECT_EQ(back.method, "monocular_bbox");
}

TEST(TrackerConfig, each_key_changes_its_field_alone) {
  const json defaults = to_json(TrackerConfig{});
  int fields = 0;
  for (const auto& [section, content] : defaults.items()) {
    if (!content.is_object()) continue;
    for (const auto& [key, value] : content.items()) {
      json expected = defaults;
      expected[section][key] = changed(value);
      const json only = {{section, {{key, changed(value)}}}};
      EXPECT_EQ(to_json(read(only)), expected) << section << "." << key;
      ++fields;
    }
  }
  EXPECT_EQ(fields, 34);
}

TEST(TrackerConfig, keys_reach_the_fields_that_they_name) {
  const TrackerConfig config = read(json::parse(R"({
    "registration": {"occlusion_tolerance_m": 0.02},
    "segmentation": {"color_space": "rgb", "majority_filter": true, "surface_majority": true, "largest_component": true},
    "volume": {"z_min_m": 0.5, "z_max_m": 0.8},
    "database": {"view_distance_m": 0.6, "field_of_view_deg": 30, "image_size_px": 128, "field_cap_share": 0.4},
    "detection": {"min_pixels": 99, "second_hand_share": 0.2, "component_depth_step_m": 0.03, "max_border_pixels": 3,
                  "max_border_share": 0.6},
    "lookup": {"cascade": "8:9", "implementation": "plain", "interpolation_epsilon_px": 0.1, "turn_to_ray": false, "max_matching_error_share": 0.2},
    "icp": {"algorithm": "robust", "implementation": "plain", "center_visible_surface": false, "max_points": 500, "subsampling_factor": 20, "max_iterations": 50, "convergence_share": 0.01,
            "cull_each_iteration": true, "color_sensitive": false, "max_residual_m": 0.01},
    "smoothing": {"posture_keep": 0.5, "pose_keep": 0.25, "forget_after_frames": 4}})"));
  EXPECT_EQ(config.registration.occlusion_tolerance, 0.02);
  EXPECT_EQ(config.lookup.implementation, "plain");
  EXPECT_EQ(config.icp.implementation, Implementation::plain);
  EXPECT_EQ(config.segmentation.color_space, ColorSpace::rgb);
  EXPECT_TRUE(config.segmentation.majority_filter);
  EXPECT_TRUE(config.segmentation.surface_majority);
  EXPECT_TRUE(config.segmentation.largest_component);
  EXPECT_EQ(config.volume.z_min, 0.5);
  EXPECT_EQ(config.volume.z_max, 0.8);
  EXPECT_EQ(config.views.distance, 0.6);
  EXPECT_EQ(config.views.field_of_view_deg, 30);
  EXPECT_EQ(config.views.image_size, 128);
  EXPECT_EQ(config.views.field_cap_share, 0.4);
  EXPECT_EQ(config.detection.min_pixels, 99);
  EXPECT_EQ(config.detection.second_hand_share, 0.2);
  EXPECT_EQ(config.detection.component_depth_step, 0.03);
  EXPECT_EQ(config.detection.max_border_pixels, 3);
  EXPECT_EQ(config.detection.max_border_share, 0.6);
  EXPECT_EQ(config.lookup.cascade, (Cascade{{8, 9}}));
  EXPECT_EQ(config.lookup.interpolation_epsilon, 0.1);
  EXPECT_FALSE(config.lookup.turn_to_ray);
  EXPECT_EQ(config.lookup.max_matching_error, 0.2);
  EXPECT_EQ(config.icp.algorithm, "robust");
  EXPECT_FALSE(config.icp.center_visible_surface);
  EXPECT_EQ(config.icp.max_points, 500);
  EXPECT_EQ(config.icp.subsampling_factor, 20);
  EXPECT_FALSE(config.icp.color_sensitive);
  EXPECT_EQ(config.icp.max_iterations, 50);
  EXPECT_EQ(config.icp.convergence_share, 0.01);
  EXPECT_TRUE(config.icp.cull_each_iteration);
  EXPECT_EQ(config.max_residual, 0.01);
  EXPECT_EQ(config.smoothing.posture_keep, 0.5);
  EXPECT_EQ(config.smoothing.pose_keep, 0.25);
  EXPECT_EQ(config.smoothing.forget_after, 4);
}

TEST(TrackerConfig, overrides_the_base_where_it_says_something) {
  TrackerConfig base;
  base.icp.max_points = 77;
  base.volume.z_max = 0.9;
  const TrackerConfig config = config_from_json(json{{"volume", {{"z_max_m", 0.8}}}}, base, "here");
  EXPECT_EQ(config.icp.max_points, 77);
  EXPECT_EQ(config.volume.z_max, 0.8);
  EXPECT_EQ(to_json(config_from_json(json::object(), base, "here")), to_json(base));
}

TEST(TrackerConfig, refuses_unknown_keys_and_lists_the_known_ones) {
  expect_refused({{"icpp", json::object()}}, {"icpp", "unknown key", "icp", "profile"});
  expect_refused({{"icp", {{"max_point", 3}}}}, {"icp: ", "unknown key \"max_point\"", "max_points"});
  // A key of another section does not count.
  expect_refused({{"volume", {{"max_points", 3}}}}, {"volume: ", "unknown key \"max_points\""});
  expect_refused({{"profile", "fast"}}, {"fast", "paper"});
  expect_refused({{"method", "best"}}, {"method: found \"best\"", "schroeder2012"});
}

TEST(TrackerConfig, refuses_wrong_types) {
  expect_refused(json::array(), {"an object"});
  expect_refused(3, {"an object"});
  expect_refused({{"icp", 3}}, {"icp", "an object"});
  expect_refused({{"profile", 3}}, {"profile", "a text"});
  expect_refused({{"method", 3}}, {"method", "a text"});
  expect_refused({{"icp", {{"max_points", 3.5}}}}, {"icp.max_points", "3.5", "a whole number"});
  expect_refused({{"icp", {{"max_points", "3"}}}}, {"icp.max_points", "a whole number"});
  expect_refused({{"icp", {{"max_points", 3'000'000'000}}}}, {"icp.max_points", "3000000000"});
  expect_refused({{"icp", {{"max_points", 18'446'744'073'709'551'615u}}}}, {"icp.max_points"});
  expect_refused({{"icp", {{"cull_each_iteration", 1}}}}, {"icp.cull_each_iteration", "true or false"});
  expect_refused({{"volume", {{"z_min_m", nullptr}}}}, {"volume.z_min_m", "null", "a number"});
  expect_refused({{"lookup", {{"cascade", 64}}}}, {"lookup.cascade", "16:500,64:3"});
  expect_refused({{"lookup", {{"cascade", "16:3,64:500"}}}}, {"lookup.cascade", "64:500"});
  expect_refused({{"lookup", {{"cascade", ""}}}}, {"lookup.cascade"});
  expect_refused({{"icp", {{"algorithm", "icp"}}}}, {"icp.algorithm", "icp", "horn", "robust"});
  for (const char* section : {"lookup", "icp"}) {
    expect_refused({{section, {{"implementation", "quick"}}}},
                   {section, "implementation", "quick", "plain", "fast"});
    expect_refused({{section, {{"implementation", 1}}}}, {section, "implementation", "plain", "fast"});
  }
  expect_refused({{"segmentation", {{"color_space", "hsv"}}}}, {"segmentation.color_space", "hsv", "yuv", "rgb"});
  expect_refused({{"segmentation", {{"color_space", 3}}}}, {"segmentation.color_space", "yuv", "rgb"});
}

TEST(TrackerConfig, each_number_has_a_range) {
  const json defaults = to_json(TrackerConfig{});
  int numbers = 0;
  for (const auto& [section, content] : defaults.items()) {
    if (!content.is_object()) continue;
    for (const auto& [key, value] : content.items()) {
      if (!value.is_number()) continue;
      expect_refused({{section, {{key, -1}}}}, {section + "." + key, "found -1"});
      ++numbers;
    }
  }
  EXPECT_EQ(numbers, 22);
  expect_refused({{"smoothing", {{"posture_keep", 1.0}}}}, {"smoothing.posture_keep", "0.999"});
  expect_refused({{"icp", {{"max_points", 2}}}}, {"icp.max_points", "[3, 307200]"});
  expect_refused({{"volume", {{"z_min_m", 0}}}}, {"volume.z_min_m", "above 0"});
  expect_refused({{"detection", {{"second_hand_share", 1.01}}}}, {"detection.second_hand_share", "(0, 1]"});
}

TEST(TrackerConfig, each_field_says_what_it_is) {
  const std::vector<ConfigField> fields = config_fields(TrackerConfig{});
  json written;
  for (const ConfigField& field : fields) {
    EXPECT_FALSE(field.what.meaning.empty() || field.range.empty()) << field.what.field;
    std::string pointer = "/" + std::string(field.what.field);
    std::ranges::replace(pointer, '.', '/');
    written[json::json_pointer(pointer)] = json::parse(field.value);
  }
  EXPECT_EQ(written, to_json(TrackerConfig{}));
  const auto cascade =
      std::ranges::find(fields, "lookup.cascade", [](const ConfigField& f) { return f.what.field; });
  EXPECT_THAT(cascade->what.paper, HasSubstr("k nearest neighbor"));
  const auto distance =
      std::ranges::find(fields, "database.view_distance_m", [](const ConfigField& f) { return f.what.field; });
  EXPECT_EQ(distance->unit, "m");
  EXPECT_EQ(distance->range, "[0.3, 10]");
}

TEST(TrackerConfig, lists_all_problems_at_once) {
  expect_refused({{"volume", {{"z_min_m", 0.9}, {"z_max_m", 0.5}}}, {"icp", {{"max_iterations", 0}}}},
                 {"volume.z_min_m: found 0.9", "less than z_max_m = 0.5", "icp.max_iterations: found 0"});
  TrackerConfig config;
  config.volume = {0.7, 0.7};
  config.icp.convergence_share = std::numeric_limits<double>::quiet_NaN();
  config.lookup.cascade.clear();
  EXPECT_EQ(config.problems().size(), 3u);
}

}  // namespace
}  // namespace glovebench
