#include "render/shaders.h"

namespace glovebench::render {

const char* const kSceneVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
layout(location = 3) in uint patch_id;
layout(location = 4) in vec3 pattern_position;
uniform mat4 T_ir_object;
uniform mat4 T_view_ir;
uniform mat4 projection;
out vec3 p_ir;
out vec3 normal_ir;
out vec3 p_pattern;
out float z;
flat out uint vertex_material;
flat out uint vertex_patch;
void main() {
  vec4 p = T_ir_object * vec4(position, 1.0);
  vec4 p_view = T_view_ir * p;
  p_ir = p.xyz;
  normal_ir = mat3(T_ir_object) * normal;
  p_pattern = pattern_position;
  z = p_view.z;
  vertex_material = material;
  vertex_patch = patch_id;
  gl_Position = projection * p_view;
}
)";

const char* const kTruthShader = R"(#version 450 core
in float z;
flat in uint vertex_material;
flat in uint vertex_patch;
uniform int color_count;
layout(location = 0) out uint out_label;
layout(location = 1) out uint out_patch;
layout(location = 2) out float out_z;
void main() {
  out_label = vertex_material <= uint(color_count) ? vertex_material : 0u;
  out_patch = vertex_patch;
  out_z = z;
}
)";

const char* const kLitShader = R"(#version 450 core
in vec3 p_ir;
in vec3 normal_ir;
in vec3 p_pattern;
flat in uint vertex_material;
uniform vec4 reflection[32];  // albedo, gloss
uniform vec4 surface[32];     // shininess, pattern amplitude, pattern size (m), unused
uniform vec3 to_light;        // unit length
uniform vec3 light_rgb;
uniform float ambient_share;
uniform vec3 eye_ir;
layout(location = 0) out vec4 out_rgb;

float lattice(ivec3 cell) {
  uvec3 q = uvec3(cell) * uvec3(1597334673u, 3812015801u, 2798796415u);
  uint h = q.x ^ q.y ^ q.z;
  h = (h ^ (h >> 15)) * 2246822519u;
  h ^= h >> 13;
  return float(h >> 8) / 8388608.0 - 1.0;
}

// Value noise in -1..1.
float pattern(vec3 p) {
  ivec3 i = ivec3(floor(p));
  vec3 f = fract(p);
  float near_side = mix(mix(lattice(i), lattice(i + ivec3(1, 0, 0)), f.x),
                        mix(lattice(i + ivec3(0, 1, 0)), lattice(i + ivec3(1, 1, 0)), f.x), f.y);
  float far_side = mix(mix(lattice(i + ivec3(0, 0, 1)), lattice(i + ivec3(1, 0, 1)), f.x),
                       mix(lattice(i + ivec3(0, 1, 1)), lattice(i + ivec3(1, 1, 1)), f.x), f.y);
  return mix(near_side, far_side, f.z);
}

void main() {
  vec4 color = reflection[vertex_material];
  vec4 finish = surface[vertex_material];
  vec3 n = normalize(normal_ir);
  float facing = dot(n, to_light);
  float diffuse = ambient_share + (1.0 - ambient_share) * max(facing, 0.0);
  vec3 half_way = normalize(to_light + normalize(eye_ir - p_ir));
  float highlight = facing > 0.0 ? color.a * (1.0 - ambient_share) * pow(max(dot(n, half_way), 0.0), finish.x) : 0.0;
  float variation = finish.y > 0.0 ? 1.0 + finish.y * pattern(p_pattern / finish.z) : 1.0;
  out_rgb = vec4(light_rgb * (color.rgb * (variation * diffuse) + highlight), 1.0);
}
)";

const char* const kResolveVertexShader = R"(#version 450 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

const char* const kResolveShader = R"(#version 450 core
uniform sampler2D samples;
layout(location = 0) out vec4 out_rgb;
void main() {
  ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
  vec3 linear = 0.25 * (texelFetch(samples, corner, 0).rgb + texelFetch(samples, corner + ivec2(1, 0), 0).rgb +
                        texelFetch(samples, corner + ivec2(0, 1), 0).rgb +
                        texelFetch(samples, corner + ivec2(1, 1), 0).rgb);
  linear = clamp(linear, 0.0, 1.0);
  vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
  out_rgb = vec4(mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308))), 1.0);
}
)";

}  // namespace glovebench::render
