#pragma once

#include <Eigen/Core>
#include <array>

#include "core/base/image.h"

namespace glovebench::render {

enum class Shader {
  first_subject,   ///< matte fabric
  second_subject,  ///< slightly other dyes, more gloss, a fine weave
};

/// Linear RGB albedos of the labels; index 0 is unused. Simulated annealing maximized the smallest UV distance
/// between colors and to skin, table and floor from 3000 to 6500 K: 18.2 gray levels.
const std::array<Eigen::Vector3f, kColorCount + 1>& glove_albedos(Shader shader);

/// For pictures of label images; black for 0.
const std::array<Rgb, kColorCount + 1>& label_palette();

}  // namespace glovebench::render
