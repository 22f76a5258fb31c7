#pragma once

#include <string>

#include "core/base/image.h"

namespace glovebench::render {

/// One frame as channels of one image: the truth, and beside it in the layer "tracker" what the tracker believes.
/// All images that are not empty have one size; empty ones are left out of the file.
struct FrameLayers {
  ColorImage color;          ///< R, G, B (32-bit float; stored as linear light)
  DepthImage depth;          ///< Z, metres (32-bit float)
  LabelImage label;          ///< label (32-bit unsigned)
  DepthImage tracker_depth;  ///< tracker.Z: of the estimated hand
  LabelImage tracker_label;  ///< tracker.label: of the estimated hand
};

/// The bytes of a multi-channel OpenEXR file. Throws Error naming `where` if the images differ in size or are all
/// empty.
std::string encode_exr(const FrameLayers& layers, const std::string& where);
/// Writes them, whole or not at all. Throws Error.
void write_exr(const std::string& path, const FrameLayers& layers);
/// Reads what `write_exr` wrote; colors come back exactly. Throws Error if it is not such a file.
FrameLayers read_exr(const std::string& path);
/// The same of a file's content; `where` names it.
FrameLayers parse_exr(const std::string& content, const std::string& where);

}  // namespace glovebench::render
