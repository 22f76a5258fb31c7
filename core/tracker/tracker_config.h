#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/database/look_up.h"
#include "core/methods/method_names.h"
#include "core/pose/icp.h"
#include "core/segmentation/color_table.h"

namespace glovebench {

struct SegmentationConfig {
  ColorSpace color_space = ColorSpace::yuv;  ///< of the color table; the paper's is YUV
  bool majority_filter = false;              ///< 3x3 majority of the labels; not in the paper
  bool surface_majority = false;             ///< of the neighbors on the same surface (2 cm); not in the paper
  bool largest_component = false;            ///< keep the largest connected component; not in the paper
};

struct LookupConfig {
  Cascade cascade = {{16, 500}, {64, 3}};  ///< the paper's choice (section IV-B)
  double interpolation_epsilon = 0.01;     ///< eps in the weights 1 / (E + eps), px of the last stage, > 0
  std::string implementation = "fast";     ///< a name of `look_ups`; the matches are the same
  double max_matching_error = 0.08;  ///< above it the frame is `poor_match`, share of the last stage's side, > 0
};

struct SmoothingConfig {
  double posture_keep = 0.75;  ///< x = keep * previous + (1 - keep) * new, in [0, 1)
  double pose_keep = 0.0;      ///< the same for the pose (slerp for the rotation), in [0, 1)
  int forget_after = 15;       ///< lost frames after which the filter starts anew, >= 1
};

struct DetectionConfig {
  int min_pixels = 150;            ///< fewer glove pixels: no hand, >= 3
  double second_hand_share = 0.3;  ///< a second component above this share of the largest: several hands, (0, 1]
  double component_depth_step = 0.05;  ///< neighbors farther apart in depth are not connected, m, > 0
  int max_border_pixels = 40;          ///< more glove pixels than this on the image border: cut by it, >= 0
  double max_border_share = 0.35;  ///< the same, as a share of the square root of all glove pixels: a single finger
                                   ///< that reaches into the image touches its border with few pixels, > 0
};

/// A named, complete configuration ("profile") of the tracker. `paper` does what the paper says.
struct TrackerConfig {
  std::string profile = "paper";
  std::string method{kPaperMethod};  ///< `method_names` (core/methods) lists all
  RegistrationConfig registration;
  SegmentationConfig segmentation;
  WorkingVolume volume;
  ViewConfig views;  ///< of the databases
  DetectionConfig detection;
  LookupConfig lookup;
  IcpConfig icp;
  double max_residual = 0.02;  ///< a larger mean distance after the alignment is `poor_alignment`, m, > 0
  SmoothingConfig smoothing;

  /// All problems, one per line; empty if there are none.
  std::vector<std::string> problems() const;
};

/// The profile of that name ("paper"). Throws Error listing the known ones.
TrackerConfig profile(const std::string& name);
/// Overrides the fields of `base` that stand in the JSON object. Unknown keys, wrong types and values out of
/// range throw Error naming `where` and the key.
TrackerConfig config_from_json(const nlohmann::json& json, const TrackerConfig& base, const std::string& where);
nlohmann::json to_json(const TrackerConfig& config);

}  // namespace glovebench
