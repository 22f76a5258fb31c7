#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/segmentation/color_table.h"
#include "eval/workbench.h"
#include "render/lighting.h"
#include "render/rgbd_renderer.h"

namespace glovebench::eval {

/// Half to double strength, 3000 to 6500 K, from directions that no calibrated lighting has.
std::vector<render::Lighting> held_out_lightings();

/// How a color table does, over the pixels of the IR camera that have a color and lie in the working volume: what
/// the tracker makes its cloud of. The bare forearm is there too.
struct LabelErrors {
  int glove = 0;       ///< pixels that truly are
  int missed = 0;      ///< of those, unlabeled
  int labeled = 0;     ///< pixels with a label
  int wrong = 0;       ///< of those, with another than the true one
  int mislabeled = 0;  ///< glove pixels with another label than theirs, or none
  int interior = 0;    ///< glove pixels whose eight neighbors have the same true label: none is a mix of two colors
  int interior_missed = 0;                                   ///< of those, unlabeled
  int interior_mislabeled = 0;                               ///< of those, with another label than theirs, or none
  std::array<int, kColorCount + 1> glove_of{}, missed_of{};  ///< the first two for each color

  /// Of the labeled pixels; 0..1. Nothing labeled is nothing wrong.
  double wrong_share() const;
  /// Of the glove's pixels; 0..1. There must be some.
  double missed_share() const;
  /// The same of what is missed or wrong.
  double mislabeled_share() const;
  /// The same of the interior's pixels, and of all others, where labels meet. There must be some.
  double interior_mislabeled_share() const;
  double border_mislabeled_share() const;
  /// 0 of a color that is not seen.
  double missed_share_of(int color) const;
  /// The color with the largest missed share.
  int worst_color() const;
  LabelErrors& operator+=(const LabelErrors& other);
};

/// What is done to the labels of a table: nothing, as in the paper; majority_filter; surface_majority.
enum class LabelFilter { none, majority, surface };

/// The errors in one frame, labeled as the paper's tracker does, or with a filter.
LabelErrors label_errors(const render::RgbdImages& truth, const DeviceFrame& frame,
                         const RgbdCalibration& calibration, const ColorTable& table,
                         LabelFilter filter = LabelFilter::none);

/// The errors of color tables under lightings, [lighting][table], over four hands of the source trajectories, open
/// and closed, at four places. All tables see the same frames, with the paper's noise.
std::vector<std::vector<LabelErrors>> measure_label_errors(
    Workbench& workbench, int subject, std::span<const render::Lighting> lightings,
    std::span<const std::shared_ptr<const ColorTable>> tables);

}  // namespace glovebench::eval
