#pragma once

// OpenGL programs of the RGB-D renderer.

namespace glovebench::render {

/// Attributes: 0 position, 1 normal, 2 material, 3 patch, 4 pattern position (all in the object's frame).
extern const char* const kSceneVertexShader;
/// Writes label, patch and metric z.
extern const char* const kTruthShader;
/// Writes linear RGB.
extern const char* const kLitShader;
/// A triangle over the whole image.
extern const char* const kResolveVertexShader;
/// Averages 2x2 samples of linear RGB and codes them as sRGB.
extern const char* const kResolveShader;

}  // namespace glovebench::render
