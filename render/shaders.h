#pragma once

namespace glovebench::render {

/// Attributes: position, normal, material, patch, pattern position, object frame.
extern const char* const kSceneVertexShader;
/// Writes label, patch and metric z.
extern const char* const kTruthShader;
/// Writes linear RGB.
extern const char* const kLitShader;
/// Covers the image.
extern const char* const kResolveVertexShader;
/// Averages 2x2 samples; writes sRGB.
extern const char* const kResolveShader;

}  // namespace glovebench::render
