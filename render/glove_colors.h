#pragma once

#include <Eigen/Core>
#include <array>

#include "core/base/image.h"

namespace glovebench::render {

/// Whose glove is drawn, and with which reflection.
enum class Shader {
  first_subject,   ///< matte, even fabric
  second_subject,  ///< dyes that differ by a few percent, more gloss, a fine weave
};

/// Linear RGB albedo of each label; index 0 is unused.
///
/// The first subject's table is the result of a search (simulated annealing over albedos whose largest channel is
/// 0.5 and smallest at least 0.02) for the largest smallest distance between any two colors, and between any color
/// and skin, table and floor, under lights of 3000, 4000, 5000 and 6500 K with and without 3% of gloss, where every
/// light of one may meet every light of the other. Distance is that of ((U - 128) / Y, (V - 128) / Y) over
/// gamma-coded RGB, times the larger Y: the UV distance in gray levels when both look equally bright. Reached: 18.2
/// levels over all lights (20.6 without gloss; 0.11 in chroma), 24.3 when both stand in the same light; 0.19 in
/// chroma at 5000 K.
const std::array<Eigen::Vector3f, kColorCount + 1>& glove_albedos(Shader shader);

/// Colors for pictures of label images; black for 0.
const std::array<Rgb, kColorCount + 1>& label_palette();

}  // namespace glovebench::render
