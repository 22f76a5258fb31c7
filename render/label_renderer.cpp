#include "render/label_renderer.h"

#include "render/context.h"
#include "render/gl.h"
#include "render/hand_mesh.h"

namespace glovebench::render {
namespace {

constexpr int kLabelPosition = 0;
constexpr int kLabel = 1;
constexpr int kLabelPatch = 2;

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in uint label;
layout(location = 2) in uint patch_id;
uniform mat4 T_camera_hand;
uniform mat4 projection;
out float z;
flat out uint vertex_label;
flat out uint vertex_patch;
void main() {
  vec4 p_camera = T_camera_hand * vec4(position, 1.0);
  z = p_camera.z;
  vertex_label = label;
  vertex_patch = patch_id;
  gl_Position = projection * p_camera;
}
)";

constexpr const char* kLabelShader = R"(#version 450 core
flat in uint vertex_label;
layout(location = 0) out uint out_label;
void main() { out_label = vertex_label; }
)";

constexpr const char* kIdShader = R"(#version 450 core
in float z;
flat in uint vertex_label;
flat in uint vertex_patch;
layout(location = 0) out uint out_label;
layout(location = 1) out uint out_patch;
layout(location = 2) out float out_z;
void main() {
  out_label = vertex_label;
  out_patch = vertex_patch;
  out_z = z;
}
)";

}  // namespace

struct LabelRenderer::State {
  Context context;
  gl::Program label_program{kVertexShader, kLabelShader};
  gl::Program id_program{kVertexShader, kIdShader};
  gl::Framebuffer label_buffer{{GL_R8UI}};
  gl::Framebuffer id_buffer{{GL_R8UI, GL_R8UI, GL_R32F}};
  gl::VertexArray vertices;
  HandMesh mesh;
  std::string model_hash;

  void load(const HandModel& model) {
    if (model.hash() == model_hash) return;
    mesh = make_hand_mesh(model.triangles());
    vertices.set_bytes(kLabel, mesh.labels);
    vertices.set_bytes(kLabelPatch, mesh.patches);
    vertices.set_indices(mesh.indices);
    model_hash = model.hash();
  }

  void draw(const gl::Program& program, gl::Framebuffer& target, const HandModel& model, const PosedHand& hand,
            const PinholeCamera& camera, const Eigen::Isometry3d& T_camera_hand) {
    load(model);
    vertices.set_floats(kLabelPosition, spread(mesh, hand.vertices), GL_STREAM_DRAW);
    gl::set_pass_state();
    target.bind(camera.width, camera.height);
    const std::array<GLuint, 4> no_id{};
    const std::array<GLfloat, 4> no_depth{};
    const GLfloat farthest = 1;
    glClearBufferuiv(GL_COLOR, 0, no_id.data());
    if (&target == &id_buffer) {
      glClearBufferuiv(GL_COLOR, 1, no_id.data());
      glClearBufferfv(GL_COLOR, 2, no_depth.data());
    }
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    program.use();
    program.set("T_camera_hand", Eigen::Matrix4f(T_camera_hand.matrix().cast<float>()));
    program.set("projection", gl::projection(camera));
    vertices.draw();
  }
};

LabelRenderer::LabelRenderer() : state_(std::make_unique<State>()) { state_->context.release(); }

LabelRenderer::~LabelRenderer() { state_->context.make_current(); }

LabelImage LabelRenderer::render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                                        const Eigen::Isometry3d& T_camera_hand) {
  const CurrentContext current(state_->context);
  state_->draw(state_->label_program, state_->label_buffer, model, hand, camera, T_camera_hand);
  LabelImage labels(camera.width, camera.height);
  state_->label_buffer.read(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 0, 0, camera.width, camera.height, labels.data());
  return labels;
}

HandImages LabelRenderer::render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                                     const Eigen::Isometry3d& T_camera_hand) {
  const CurrentContext current(state_->context);
  state_->draw(state_->id_program, state_->id_buffer, model, hand, camera, T_camera_hand);
  const int width = camera.width;
  const int height = camera.height;
  HandImages images{LabelImage(width, height), Image<uint8_t>(width, height), DepthImage(width, height)};
  state_->id_buffer.read(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 0, 0, camera.width, camera.height,
                         images.label.data());
  state_->id_buffer.read(1, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 0, 0, camera.width, camera.height,
                         images.patch.data());
  state_->id_buffer.read(2, GL_RED, GL_FLOAT, 0, 0, camera.width, camera.height, images.depth.data());
  return images;
}

ViewRendererFactory label_renderer_factory() {
  return [] { return std::make_unique<LabelRenderer>(); };
}

}  // namespace glovebench::render
