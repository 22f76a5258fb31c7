#pragma once

#include <Eigen/Core>
#include <array>

#include "core/base/image.h"

namespace glovebench::render {

enum class Shader {
  first_subject,   ///< matte fabric
  second_subject,  ///< slightly other dyes, more gloss, a fine weave
};

/// Linear RGB by label, chosen for distance in UV from each other, skin, table and floor under 3000 to 6500 K.
/// Index 0 is unused.
const std::array<Eigen::Vector3f, kColorCount + 1>& glove_albedos(Shader shader);

/// Colors in pictures. 0 is black.
const std::array<Rgb, kColorCount + 1>& label_palette();

}  // namespace glovebench::render
