#pragma once

#include <string>

#include "core/base/image.h"

namespace glovebench::render {

/// Truth and the tracker's estimate. Images have one size; empty ones are left out.
struct FrameLayers {
  ColorImage color;          ///< linear R, G, B, 32-bit float
  DepthImage depth;          ///< Z, m, 32-bit float
  LabelImage label;          ///< label, 32-bit unsigned
  DepthImage tracker_depth;  ///< tracker.Z
  LabelImage tracker_label;  ///< tracker.label
};

/// Throws: Error if sizes differ or all images are empty.
std::string encode_exr(const FrameLayers& layers, const std::string& where);

}  // namespace glovebench::render
