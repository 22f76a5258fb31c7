#include "render/rgbd_renderer.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "render/context.h"
#include "render/gl.h"
#include "render/hand_mesh.h"
#include "render/shaders.h"

namespace glovebench::render {
namespace {

enum Attribute { kPosition, kNormal, kMaterial, kPatch, kPatternPosition };

constexpr int kSamplesAcross = 2;

/// The camera whose pixels are the samples of `camera`: each pixel split in kSamplesAcross^2.
PinholeCamera sample_camera(const PinholeCamera& camera) {
  constexpr double k = kSamplesAcross;
  return {camera.width * kSamplesAcross, camera.height * kSamplesAcross, camera.fx * k, camera.fy * k,
          (camera.cx + 0.5) * k - 0.5,   (camera.cy + 0.5) * k - 0.5};
}

void load_static(gl::VertexArray& target, const SurfaceMesh& mesh) {
  target.set_floats(kPosition, mesh.vertices, GL_STATIC_DRAW);
  target.set_floats(kNormal, mesh.normals, GL_STATIC_DRAW);
  target.set_bytes(kMaterial, mesh.materials);
  target.set_bytes(kPatch, std::vector<uint8_t>(mesh.vertices.size(), 0));
  target.set_floats(kPatternPosition, mesh.vertices, GL_STATIC_DRAW);
  target.set_indices(mesh.indices);
}

}  // namespace

struct RgbdRenderer::State {
  State(std::shared_ptr<const HandModel> hand_model, const SceneConfig& config)
      : model(std::move(hand_model)), scene(make_scene(config)), mesh(make_hand_mesh(*model)) {
    load_static(surroundings, scene.surroundings);
    load_static(forearm, make_forearm(*model));
    hand_vertices.set_bytes(kMaterial, mesh.labels);
    hand_vertices.set_bytes(kPatch, mesh.patches);
    hand_vertices.set_floats(kPatternPosition, spread(mesh, model->pose(Posture::Zero()).vertices), GL_STATIC_DRAW);
    hand_vertices.set_indices(mesh.indices);
  }

  void load(const PosedHand& hand) {
    hand_vertices.set_floats(kPosition, spread(mesh, hand.vertices), GL_STREAM_DRAW);
    hand_vertices.set_floats(kNormal, spread(mesh, vertex_normals(*model, hand)), GL_STREAM_DRAW);
  }

  void draw_all(const gl::Program& program, const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir,
                const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand) {
    const auto set_pose = [&program](const Eigen::Isometry3d& T_ir_object) {
      program.set("T_ir_object", Eigen::Matrix4f(T_ir_object.matrix().cast<float>()));
    };
    program.set("projection", gl::projection(camera));
    program.set("T_view_ir", Eigen::Matrix4f(T_view_ir.matrix().cast<float>()));
    set_pose(Eigen::Isometry3d::Identity());
    surroundings.draw();
    set_pose(T_camera_hand * hand.T_hand_joint[kForearmJoint]);
    forearm.draw();
    set_pose(T_camera_hand);
    hand_vertices.draw();
  }

  void draw_truth(const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir, const PosedHand& hand,
                  const Eigen::Isometry3d& T_camera_hand) {
    gl::set_pass_state();
    truth_buffer.bind(camera.width, camera.height);
    const std::array<GLuint, 4> no_id{};
    const std::array<GLfloat, 4> no_depth{};
    const GLfloat farthest = 1;
    glClearBufferuiv(GL_COLOR, 0, no_id.data());
    glClearBufferuiv(GL_COLOR, 1, no_id.data());
    glClearBufferfv(GL_COLOR, 2, no_depth.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    truth_program.use();
    truth_program.set("color_count", kColorCount);
    draw_all(truth_program, camera, T_view_ir, hand, T_camera_hand);
  }

  void set_light(const Lighting& lighting, const Eigen::Isometry3d& T_view_ir) {
    std::vector<Eigen::Vector4f> reflection;
    std::vector<Eigen::Vector4f> surface;
    for (const Material& m : scene.materials) {
      reflection.emplace_back(m.albedo.x(), m.albedo.y(), m.albedo.z(), m.gloss);
      surface.emplace_back(m.shininess, m.pattern, m.pattern_size, 0.0f);
    }
    const Eigen::Vector3d light = lighting.strength * rgb_of_temperature(lighting.temperature_k);
    lit_program.set("reflection", reflection);
    lit_program.set("surface", surface);
    lit_program.set("to_light", Eigen::Vector3f(lighting.direction_to_light.normalized().cast<float>()));
    lit_program.set("light_rgb", Eigen::Vector3f(light.cast<float>()));
    lit_program.set("ambient_share", static_cast<float>(lighting.ambient_share));
    lit_program.set("eye_ir", Eigen::Vector3f(T_view_ir.inverse().translation().cast<float>()));
  }

  ColorImage draw_color(const RgbdCalibration& calibration, const PosedHand& hand,
                        const Eigen::Isometry3d& T_camera_hand, const Lighting& lighting) {
    const PinholeCamera samples = sample_camera(calibration.rgb);
    gl::set_pass_state();
    sample_buffer.bind(samples.width, samples.height);
    const std::array<GLfloat, 4> black{};
    const GLfloat farthest = 1;
    glClearBufferfv(GL_COLOR, 0, black.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    lit_program.use();
    set_light(lighting, calibration.T_rgb_ir);
    draw_all(lit_program, samples, calibration.T_rgb_ir, hand, T_camera_hand);
    return resolve(calibration.rgb.width, calibration.rgb.height);
  }

  ColorImage resolve(int width, int height) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    color_buffer.bind(width, height);
    resolve_program.use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sample_buffer.texture(0));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    resolve_program.set("samples", 0);
    glBindVertexArray(no_attributes.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<std::array<uint8_t, 4>> rgba(static_cast<size_t>(width) * height);
    color_buffer.read(0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    ColorImage color(width, height);
    for (size_t i = 0; i < rgba.size(); ++i) color[i] = {rgba[i][0], rgba[i][1], rgba[i][2]};
    return color;
  }

  Context context;
  std::shared_ptr<const HandModel> model;
  Scene scene;
  HandMesh mesh;
  gl::Program truth_program{kSceneVertexShader, kTruthShader};
  gl::Program lit_program{kSceneVertexShader, kLitShader};
  gl::Program resolve_program{kResolveVertexShader, kResolveShader};
  gl::Framebuffer truth_buffer{{GL_R8UI, GL_R8UI, GL_R32F}};
  gl::Framebuffer sample_buffer{{GL_RGBA16F}};
  gl::Framebuffer color_buffer{{GL_RGBA8}};
  gl::VertexArray surroundings;
  gl::VertexArray forearm;
  gl::VertexArray hand_vertices;
  gl::VertexArray no_attributes;
};

RgbdRenderer::RgbdRenderer(const RgbdCalibration& calibration, std::shared_ptr<const HandModel> model,
                           const SceneConfig& scene)
    : calibration_(calibration), state_(std::make_unique<State>(std::move(model), scene)) {}

RgbdRenderer::~RgbdRenderer() {
  state_->context.make_current();
}

RgbdImages RgbdRenderer::render(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand,
                                const Lighting& lighting) {
  const std::vector<std::string> problems = lighting.problems();
  if (!problems.empty()) throw Error("lighting: " + problems.front());
  state_->context.make_current();
  state_->load(hand);
  state_->draw_truth(calibration_.ir, Eigen::Isometry3d::Identity(), hand, T_camera_hand);
  const int width = calibration_.ir.width;
  const int height = calibration_.ir.height;
  RgbdImages images{{}, DepthImage(width, height), LabelImage(width, height), Image<uint8_t>(width, height)};
  state_->truth_buffer.read(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, images.label.data());
  state_->truth_buffer.read(1, GL_RED_INTEGER, GL_UNSIGNED_BYTE, images.patch.data());
  state_->truth_buffer.read(2, GL_RED, GL_FLOAT, images.depth.data());
  images.color = state_->draw_color(calibration_, hand, T_camera_hand, lighting);
  return images;
}

LabelImage RgbdRenderer::render_color_labels(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand) {
  state_->context.make_current();
  state_->load(hand);
  state_->draw_truth(calibration_.rgb, calibration_.T_rgb_ir, hand, T_camera_hand);
  LabelImage labels(calibration_.rgb.width, calibration_.rgb.height);
  state_->truth_buffer.read(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, labels.data());
  return labels;
}

}  // namespace glovebench::render
