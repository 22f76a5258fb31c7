#include "core/tracker/config_meanings.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr auto kMeanings = std::to_array<ConfigMeaning>({
    {"profile", "a named, complete configuration, which the other fields change", ""},
    {"method", "how to track; `glovebench list methods` describes each", ""},
    {"registration.occlusion_tolerance_m",
     "a depth pixel gets no color if another surface is this much nearer on its color ray",
     "RGBD-mapping to the mapped image M, section III-A"},
    {"segmentation.color_space", "of the lookup table that labels colors",
     "color segmentation in the YUV color space, section III-A"},
    {"segmentation.majority_filter", "each label becomes that of most of its 3 x 3 neighbors", ""},
    {"segmentation.surface_majority", "the same, among neighbors within 2 cm of depth", ""},
    {"segmentation.largest_component", "keep the largest connected part of the cloud alone", ""},
    {"volume.z_min_m", "nearest depth of a glove point", "working volume, equation (1), section III-A"},
    {"volume.z_max_m", "farthest depth of a glove point", "working volume, equation (1), section III-A"},
    {"database.view_distance_m", "from the camera of a view to the hand",
     "camera positions on a virtual sphere, section III"},
    {"database.field_of_view_deg", "of the camera that renders the views", "camera views, section III"},
    {"database.image_size_px", "side of a rendered view, before it becomes tiny images",
     "tiny images, section III"},
    {"database.field_cap_share", "largest distance in a distance field, as a share of the tiny image's side",
     "distance transforms by chamfering, section III-B"},
    {"detection.min_pixels", "fewer glove pixels mean that no hand is in view", ""},
    {"detection.second_hand_share", "a second component above this share of the largest means several hands", ""},
    {"detection.component_depth_step_m", "neighbors farther apart in depth belong to different components", ""},
    {"detection.max_border_pixels", "more glove pixels at the image border mean that the hand is cut", ""},
    {"detection.max_border_share",
     "the same for a single finger, as a share of the square root of all glove pixels", ""},
    {"lookup.cascade",
     "stages of the search: tiny images of SIZE x SIZE, then the KEEP nearest go on; the last KEEP are "
     "interpolated",
     "multi-stage k nearest neighbor lookup, matching cascade, section III-B; the number k of neighbors and the "
     "sizes "
     "D, section IV-B"},
    {"lookup.implementation", "how the database is searched; all give the same matches", ""},
    {"lookup.interpolation_epsilon_px", "eps in the weight 1 / (E + eps) of a neighbor with matching error E",
     "interpolation weighted with the matching error E, section III-B"},
    {"lookup.turn_to_ray", "turn a view's rotation from the ray to its hand to the ray to the hand in the image",
     "the coarse rotation estimate is mapped to the world coordinate frame, section III-C"},
    {"lookup.max_matching_error_share",
     "a larger error E of the best match, as a share of the last stage's side, loses the frame",
     "matching error E, Hausdorff-like distance, equation (2), section III-B"},
    {"icp.algorithm", "how the hand is aligned with the cloud; `glovebench list alignments` describes each",
     "color-sensitive Iterative Closest Point-to-Triangle (ICP-T), quaternions, section III-C"},
    {"icp.center_visible_surface",
     "start with the center of the visible surface at the cloud's center of gravity; false: the hand's origin",
     "center of gravity (COG), coarse pose estimate, section III-C"},
    {"icp.max_points", "largest number of cloud points that are aligned, by a uniform stride; the sub-sampling",
     "ICP-T sub-sampling, section IV-C"},
    {"icp.subsampling_factor", "align every nth point of the cloud, 0: as icp.max_points says",
     "ICP-T sub-sampling factor, section IV-C and Figure 9"},
    {"icp.implementation", "of the closest-point search; both give the same points", "section III-C"},
    {"icp.max_iterations", "after them the alignment has not converged",
     "ICP-T iterations k = 1 ... K, section III-C"},
    {"icp.convergence_share", "stop when the mean point-to-triangle distance changes by a smaller share",
     "until the alignment error converges, section III-C"},
    {"icp.cull_each_iteration", "exclude triangles that face away before each iteration, not once before all",
     "back-face culling beforehand, section III-C"},
    {"icp.color_sensitive", "a point's closest triangle must have its color",
     "color-sensitive closest point search, section III-C"},
    {"icp.max_residual_m", "a larger mean distance after the alignment loses the frame",
     "alignment error, section III-C"},
    {"smoothing.posture_keep", "share of the previous posture in the reported one",
     "smoothing by interpolation with the three previous frames, section III-C; Figure 5 shows 0.75"},
    {"smoothing.pose_keep", "the same of the pose, as slerp for the rotation",
     "smoothing by interpolation with the three previous frames, section III-C; Figure 5 shows none"},
    {"smoothing.forget_after_frames", "so many lost frames restart the smoothing", ""},
});

}  // namespace

std::span<const ConfigMeaning> config_meanings() { return kMeanings; }

const ConfigMeaning& config_meaning(std::string_view field) {
  const auto found = std::ranges::find(kMeanings, field, &ConfigMeaning::field);
  check(found != kMeanings.end(), "every field of the configuration has a meaning");
  return *found;
}

}  // namespace glovebench
