#include "render/rgbd_renderer.h"

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

/// A rectangle of pixels.
struct Region {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Pastes `part`, the pixels of `region`, into an image.
template <typename T>
Image<T> pasted(Image<T> image, const Region& region, const std::vector<T>& part) {
  for (int v = 0; v < region.height; ++v) {
    std::copy_n(part.data() + static_cast<ptrdiff_t>(v) * region.width, region.width,
                image.data() + static_cast<ptrdiff_t>(region.top + v) * image.width() + region.left);
  }
  return image;
}

/// Grows a region by projected points.
class RegionFinder {
 public:
  explicit RegionFinder(const PinholeCamera& camera) : camera_(camera) {}

  void add(std::span<const Eigen::Vector3f> points, const Eigen::Isometry3d& T_view_object) {
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector3d p_view = T_view_object * point.cast<double>();
      // Behind or almost at the camera a point says nothing about where its triangles are seen.
      if (p_view.z() < 2 * gl::kNear) everywhere_ = true;
      if (!everywhere_) box_.extend(camera_.project(p_view));
    }
  }
  Region region() const {
    if (everywhere_) return {0, 0, camera_.width, camera_.height};
    constexpr double kMargin = 2;  // px: a pixel's half and the rasterizer's rounding, with room to spare
    const auto clip = [](double value, int size) {
      return static_cast<int>(std::lround(std::clamp(value, 0.0, static_cast<double>(size))));
    };
    const int left = clip(box_.min().x() - kMargin, camera_.width);
    const int top = clip(box_.min().y() - kMargin, camera_.height);
    return {left, top, clip(box_.max().x() + kMargin, camera_.width) - left,
            clip(box_.max().y() + kMargin, camera_.height) - top};
  }

 private:
  PinholeCamera camera_;
  Eigen::AlignedBox2d box_;
  bool everywhere_ = false;
};

void load_static(gl::VertexArray& target, const SurfaceMesh& mesh) {
  target.set_floats(kPosition, mesh.vertices, GL_STATIC_DRAW);
  target.set_floats(kNormal, mesh.normals, GL_STATIC_DRAW);
  target.set_bytes(kMaterial, mesh.materials);
  target.set_bytes(kPatch, std::vector<uint8_t>(mesh.vertices.size(), 0));
  target.set_floats(kPatternPosition, mesh.vertices, GL_STATIC_DRAW);
  target.set_indices(mesh.indices);
}

}  // namespace

/// What stands still is drawn once for a camera and a light; in a frame only the rectangle around the hand and the
/// forearm is drawn anew.
struct RgbdRenderer::State {
  struct Truth {
    LabelImage label;
    Image<uint8_t> patch;
    DepthImage depth;
  };
  enum class Drawn { surroundings, hand, all };

  State(Subject drawn_subject, const SceneConfig& config)
      : subject(std::move(drawn_subject)), scene(make_scene(config)), mesh(make_hand_mesh(subject.triangles())) {
    const PosedHand straight = subject.pose(Posture::Zero());
    forearm_mesh = make_forearm(straight);
    load_static(surroundings, scene.surroundings);
    load_static(forearm, forearm_mesh);
    hand_vertices.set_bytes(kMaterial, mesh.labels);
    hand_vertices.set_bytes(kPatch, mesh.patches);
    hand_vertices.set_floats(kPatternPosition, spread(mesh, straight.vertices), GL_STATIC_DRAW);
    hand_vertices.set_indices(mesh.indices);
  }

  void load(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand) {
    hand_vertices.set_floats(kPosition, spread(mesh, hand.vertices), GL_STREAM_DRAW);
    hand_vertices.set_floats(kNormal, spread(mesh, vertex_normals(subject.triangles(), hand)), GL_STREAM_DRAW);
    T_ir_hand = T_camera_hand;
    T_ir_forearm = T_camera_hand * hand.T_hand_joint[kForearmJoint];
    hand_points = hand.vertices;
  }

  Region find_region(const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir) const {
    RegionFinder finder(camera);
    finder.add(hand_points, T_view_ir * T_ir_hand);
    finder.add(forearm_mesh.vertices, T_view_ir * T_ir_forearm);
    return finder.region();
  }

  void draw_meshes(const gl::Program& program, const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir,
                   Drawn drawn) {
    const auto set_pose = [&program](const Eigen::Isometry3d& T_ir_object) {
      program.set("T_ir_object", Eigen::Matrix4f(T_ir_object.matrix().cast<float>()));
    };
    program.set("projection", gl::projection(camera));
    program.set("T_view_ir", Eigen::Matrix4f(T_view_ir.matrix().cast<float>()));
    // From near to far, so that hidden surfaces are not shaded.
    if (drawn != Drawn::surroundings) {
      set_pose(T_ir_hand);
      hand_vertices.draw();
    }
    if (drawn == Drawn::hand) return;
    if (drawn == Drawn::all) {
      set_pose(T_ir_forearm);
      forearm.draw();
    }
    set_pose(Eigen::Isometry3d::Identity());
    surroundings.draw();
  }

  void draw_truth(const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir, const Region& region,
                  Drawn drawn) {
    gl::set_pass_state();
    truth_buffer.bind(camera.width, camera.height);
    gl::limit_to(region.left, region.top, region.width, region.height);
    const std::array<GLuint, 4> no_id{};
    const std::array<GLfloat, 4> no_depth{};
    const GLfloat farthest = 1;
    glClearBufferuiv(GL_COLOR, 0, no_id.data());
    glClearBufferuiv(GL_COLOR, 1, no_id.data());
    glClearBufferfv(GL_COLOR, 2, no_depth.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    truth_program.use();
    truth_program.set("color_count", kColorCount);
    draw_meshes(truth_program, camera, T_view_ir, drawn);
  }

  template <typename T>
  std::vector<T> read_truth(int attachment, GLenum format, GLenum type, const Region& region) const {
    std::vector<T> part(static_cast<size_t>(region.width) * region.height);
    truth_buffer.read(attachment, format, type, region.left, region.top, region.width, region.height, part.data());
    return part;
  }

  LabelImage draw_labels(const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir) {
    const Region region = find_region(camera, T_view_ir);
    draw_truth(camera, T_view_ir, region, Drawn::all);
    return pasted(LabelImage(camera.width, camera.height), region,
                  read_truth<uint8_t>(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, region));
  }

  Truth draw_ir(const PinholeCamera& camera) {
    const Eigen::Isometry3d T_view_ir = Eigen::Isometry3d::Identity();
    if (empty_depth.empty()) {
      const Region whole{0, 0, camera.width, camera.height};
      draw_truth(camera, T_view_ir, whole, Drawn::surroundings);
      empty_depth =
          pasted(DepthImage(camera.width, camera.height), whole, read_truth<float>(2, GL_RED, GL_FLOAT, whole));
    }
    const Region region = find_region(camera, T_view_ir);
    draw_truth(camera, T_view_ir, region, Drawn::all);
    const LabelImage none(camera.width, camera.height);
    return {pasted(none, region, read_truth<uint8_t>(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, region)),
            pasted(none, region, read_truth<uint8_t>(1, GL_RED_INTEGER, GL_UNSIGNED_BYTE, region)),
            pasted(empty_depth, region, read_truth<float>(2, GL_RED, GL_FLOAT, region))};
  }

  LabelImage read_labels(int attachment, const Region& whole) {
    return pasted(LabelImage(whole.width, whole.height), whole,
                  read_truth<uint8_t>(attachment, GL_RED_INTEGER, GL_UNSIGNED_BYTE, whole));
  }

  TrueImages draw_color_truth(const PinholeCamera& camera, const Eigen::Isometry3d& T_view_ir) {
    const Region whole{0, 0, camera.width, camera.height};
    draw_truth(camera, T_view_ir, whole, Drawn::all);
    TrueImages truth{
        pasted(DepthImage(camera.width, camera.height), whole, read_truth<float>(2, GL_RED, GL_FLOAT, whole)),
        read_labels(0, whole),
        read_labels(1, whole),
        {}};
    draw_truth(camera, T_view_ir, whole, Drawn::hand);
    truth.whole_hand = read_labels(0, whole);
    return truth;
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

  ColorImage draw_color(const RgbdCalibration& calibration, const Lighting& lighting) {
    const PinholeCamera& rgb = calibration.rgb;
    if (empty_color.empty() || lighting != empty_color_lighting) {
      const Region whole{0, 0, rgb.width, rgb.height};
      empty_color = pasted(ColorImage(rgb.width, rgb.height), whole,
                           draw_lit(calibration, lighting, whole, Drawn::surroundings));
      empty_color_lighting = lighting;
    }
    const Region region = find_region(rgb, calibration.T_rgb_ir);
    return pasted(empty_color, region, draw_lit(calibration, lighting, region, Drawn::all));
  }

  /// The coded colors of a region's pixels.
  std::vector<Rgb> draw_lit(const RgbdCalibration& calibration, const Lighting& lighting, const Region& region,
                            Drawn drawn) {
    const PinholeCamera samples = sample_camera(calibration.rgb);
    gl::set_pass_state();
    sample_buffer.bind(samples.width, samples.height);
    gl::limit_to(region.left * kSamplesAcross, region.top * kSamplesAcross, region.width * kSamplesAcross,
                 region.height * kSamplesAcross);
    const std::array<GLfloat, 4> black{};
    const GLfloat farthest = 1;
    glClearBufferfv(GL_COLOR, 0, black.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    lit_program.use();
    set_light(lighting, calibration.T_rgb_ir);
    draw_meshes(lit_program, samples, calibration.T_rgb_ir, drawn);
    return resolve(calibration.rgb, region);
  }

  std::vector<Rgb> resolve(const PinholeCamera& camera, const Region& region) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    color_buffer.bind(camera.width, camera.height);
    gl::limit_to(region.left, region.top, region.width, region.height);
    resolve_program.use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sample_buffer.texture(0));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    resolve_program.set("samples", 0);
    glBindVertexArray(no_attributes.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<std::array<uint8_t, 4>> rgba(static_cast<size_t>(region.width) * region.height);
    color_buffer.read(0, GL_RGBA, GL_UNSIGNED_BYTE, region.left, region.top, region.width, region.height,
                      rgba.data());
    std::vector<Rgb> colors(rgba.size());
    for (size_t i = 0; i < rgba.size(); ++i) colors[i] = {rgba[i][0], rgba[i][1], rgba[i][2]};
    return colors;
  }

  Context context;
  Subject subject;
  Scene scene;
  SurfaceMesh forearm_mesh;
  HandMesh mesh;
  RecycledVector<Eigen::Vector3f> hand_points;
  Eigen::Isometry3d T_ir_hand = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_ir_forearm = Eigen::Isometry3d::Identity();
  DepthImage empty_depth;  ///< of the scene without a hand
  ColorImage empty_color;
  Lighting empty_color_lighting;
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

RgbdRenderer::RgbdRenderer(const RgbdCalibration& calibration, Subject subject, const SceneConfig& scene)
    : calibration_(calibration), state_(std::make_unique<State>(std::move(subject), scene)) {
  state_->context.release();
}

RgbdRenderer::~RgbdRenderer() { state_->context.make_current(); }

RgbdImages RgbdRenderer::render(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand,
                                const Lighting& lighting) {
  const std::vector<std::string> problems = lighting.problems();
  if (!problems.empty()) throw Error("lighting: " + problems.front());
  const CurrentContext current(state_->context);
  state_->load(hand, T_camera_hand);
  State::Truth truth = state_->draw_ir(calibration_.ir);
  return {state_->draw_color(calibration_, lighting), std::move(truth.depth), std::move(truth.label),
          std::move(truth.patch)};
}

LabelImage RgbdRenderer::render_color_labels(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand) {
  const CurrentContext current(state_->context);
  state_->load(hand, T_camera_hand);
  return state_->draw_labels(calibration_.rgb, calibration_.T_rgb_ir);
}

TrueImages RgbdRenderer::render_color_truth(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand) {
  const CurrentContext current(state_->context);
  state_->load(hand, T_camera_hand);
  return state_->draw_color_truth(calibration_.rgb, calibration_.T_rgb_ir);
}

}  // namespace glovebench::render
