#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/database/look_up.h"
#include "core/pose/alignment.h"
#include "core/segmentation/color_table.h"

namespace glovebench {

inline constexpr std::string_view kPaperMethod = "schroeder2012";
/// "exec:COMMAND" is a program (core/adapters/process). Only the command line may name one.
inline constexpr std::string_view kProgramPrefix = "exec:";
inline bool is_program(std::string_view method) { return method.starts_with(kProgramPrefix); }
/// Sorted: X of each core/methods/X_method.cpp.
std::span<const std::string_view> method_names();

struct SegmentationConfig {
  ColorSpace color_space = ColorSpace::yuv;
  bool majority_filter = false;    ///< 3x3 (not in the paper)
  bool surface_majority = false;   ///< within 2 cm of depth (not in the paper)
  bool largest_component = false;  ///< not in the paper
};

struct LookupConfig {
  Cascade cascade = {{16, 500}, {64, 3}};  ///< section IV-B
  double interpolation_epsilon = 0.01;     ///< eps in 1 / (E + eps), px, > 0
  bool turn_to_ray = true;                 ///< turn views' rotations to the ray through the hand
  std::string implementation = "fast";     ///< a name of `look_ups`
  double max_matching_error = 0.08;        ///< share of the last stage's side, > 0; larger: `poor_match`
};

struct SmoothingConfig {
  double posture_keep = 0.75;  ///< x = keep * previous + (1 - keep) * new, [0, 1)
  double pose_keep = 0.0;      ///< likewise (rotation: slerp), [0, 1)
  int forget_after = 15;       ///< lost frames before a restart, >= 1
};

struct DetectionConfig {
  int min_pixels = 150;  ///< of the glove, >= 3; fewer: `no_hand`
  /// A second component above this share of the largest: `several_hands`, (0, 1].
  double second_hand_share = 0.3;
  double component_depth_step = 0.05;  ///< between components, m, > 0
  int max_border_pixels = 40;          ///< of the glove, >= 0; more: `cut_by_border`
  /// The same for one finger, as a share of the square root of all glove pixels, > 0.
  double max_border_share = 0.35;
};

struct TrackerConfig {
  std::string profile = "paper";
  std::string method{kPaperMethod};  ///< one of `method_names`, or `is_program`
  RegistrationConfig registration;
  SegmentationConfig segmentation;
  WorkingVolume volume;
  ViewConfig views;
  DetectionConfig detection;
  LookupConfig lookup;
  IcpConfig icp;
  double max_residual = 0.02;  ///< m, > 0; larger: `poor_alignment`
  SmoothingConfig smoothing;

  /// One problem per line.
  std::vector<std::string> problems() const;
};

/// "paper"; "paper-literal" also filters the pose; "recommended" is the most accurate.
/// Throws: Error for others.
TrackerConfig profile(const std::string& name);
/// `base` with the fields of a JSON object.
/// Throws: Error for an unknown, mistyped or out-of-range key.
TrackerConfig config_from_json(const nlohmann::json& json, const TrackerConfig& base, const std::string& where);
nlohmann::json to_json(const TrackerConfig& config);

struct ConfigMeaning {
  std::string_view field;  ///< "icp.max_points"
  std::string_view meaning;
  std::string_view paper = {};  ///< words and section; empty: not in the paper
};
struct ConfigField {
  ConfigMeaning what;
  std::string unit;   ///< empty: none
  std::string range;  ///< in words
  std::string value;  ///< JSON
};
/// In the order of the tracker's stages.
std::vector<ConfigField> config_fields(const TrackerConfig& config);

}  // namespace glovebench
