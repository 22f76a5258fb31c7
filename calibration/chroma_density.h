#pragma once

#include <span>
#include <vector>

#include "calibration/chroma.h"
#include "calibration/color_samples.h"

namespace glovebench::calibration {

/// A place whose neighborhood is spoken for.
struct KnownChroma {
  Chroma place = Chroma::Zero();
  double reach = 0;  ///< as far as that
};

/// How many of the samples lie about each place of the chroma plane: shares, weighted by a bell of that width whose
/// height is 1. Samples darker than `min_luma` and chroma beyond -1.2 to 2 are left out.
class ChromaDensity {
 public:
  ChromaDensity(std::span<const ColorSample> samples, double min_luma, double width);

  /// 0 outside.
  double at(const Chroma& chroma) const;
  /// The places about which more than `share` lies, and more than about their neighbors, the highest first: out of
  /// reach of those that are known, and with a valley between unless they are the higher ones; those that are found
  /// are known to those after them, with that reach. At most that many.
  std::vector<Chroma> peaks(std::vector<KnownChroma> known, double reach, double share, size_t most) const;

 private:
  static constexpr int kSide = 320;
  static constexpr double kCell = 0.01, kLeast = -1.2;

  static Eigen::Vector2i cell_of(const Chroma& chroma);
  static bool is_inside(const Eigen::Vector2i& place);
  static size_t index(const Eigen::Vector2i& place);
  void blur(double width);
  /// Is the place on the way down from what is known?
  bool is_flank(const Chroma& place, const KnownChroma& known) const;

  std::vector<double> cells_;
};

}  // namespace glovebench::calibration
