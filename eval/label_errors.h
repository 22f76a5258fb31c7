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

/// Strength 0.5 to 2, 3000 to 6500 K, other directions than in calibration.
std::vector<render::Lighting> held_out_lightings();

/// In IR pixels. Ignores glove pixels without color. Labels count only in the working volume.
struct LabelErrors {
  int glove = 0;
  int missed = 0;      ///< without a label
  int labeled = 0;     ///< with a label
  int wrong = 0;       ///< with a false label
  int mislabeled = 0;  ///< glove pixels without the true label
  int interior = 0;    ///< glove pixels whose 8 neighbors have their true label
  int interior_missed = 0;
  int interior_mislabeled = 0;
  std::array<int, kColorCount + 1> glove_of{}, missed_of{};

  /// Share of labeled pixels; 0 without any.
  double wrong_share() const;
  /// Share of glove pixels; one must exist.
  double missed_share() const;
  double mislabeled_share() const;
  /// Shares of interior and of other glove pixels; one must exist.
  double interior_mislabeled_share() const;
  double border_mislabeled_share() const;
  /// 0 for an unseen color.
  double missed_share_of(int color) const;
  int worst_color() const;
  LabelErrors& operator+=(const LabelErrors& other);
};

/// The paper uses none.
enum class LabelFilter { none, majority, surface };

LabelErrors label_errors(const render::RgbdImages& truth, const DeviceFrame& frame,
                         const RgbdCalibration& calibration, const ColorTable& table,
                         LabelFilter filter = LabelFilter::none);

/// [lighting][table], over four frames of Tr1 and Tr4 with the paper's noise.
std::vector<std::vector<LabelErrors>> measure_label_errors(
    Workbench& workbench, int subject, std::span<const render::Lighting> lightings,
    std::span<const std::shared_ptr<const ColorTable>> tables);

}  // namespace glovebench::eval
