#include "render/scene.h"

#include <numbers>

#include "core/base/math.h"

namespace glovebench::render {
namespace {

constexpr double kTableDepth = 1.06;  // m
constexpr double kFloorDepth = 1.78;  // m

/// Adds a rectangle; its normal is edge_u x edge_v.
void add_quad(SurfaceMesh& mesh, const Eigen::Vector3f& corner, const Eigen::Vector3f& edge_u,
              const Eigen::Vector3f& edge_v, uint8_t material) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const Eigen::Vector3f normal = edge_u.cross(edge_v).normalized();
  for (const Eigen::Vector3f& offset :
       {Eigen::Vector3f(0, 0, 0), edge_u, Eigen::Vector3f(edge_u + edge_v), edge_v}) {
    mesh.vertices.push_back(corner + offset);
    mesh.normals.push_back(normal);
    mesh.materials.push_back(material);
  }
  for (const uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

/// A box that stands on the table, turned about the viewing axis; center on the table and size in metres.
void add_box(SurfaceMesh& mesh, const Eigen::Vector2f& center, const Eigen::Vector3f& size, double turn_deg,
             uint8_t material) {
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(static_cast<float>(radians_from_degrees(turn_deg)), Eigen::Vector3f::UnitZ())
          .toRotationMatrix();
  const Eigen::Vector3f middle(center.x(), center.y(), static_cast<float>(kTableDepth) - size.z() / 2);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      const Eigen::Vector3f normal = R.col(axis) * sign;
      const Eigen::Vector3f edge_u = R.col(next) * (size[next] * sign);
      const Eigen::Vector3f edge_v = R.col(last) * size[last];
      add_quad(mesh, middle + normal * (size[axis] / 2) - edge_u / 2 - edge_v / 2, edge_u, edge_v, material);
    }
  }
}

/// Joins consecutive rings of `around` vertices each, wound so that the outside is counter-clockwise when rings
/// advance along the axis that their angles turn about.
void join_rings(SurfaceMesh& mesh, uint32_t first, uint32_t rings, uint32_t around) {
  for (uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t a = first + ring * around + i;
      const uint32_t b = first + ring * around + (i + 1) % around;
      for (const uint32_t index : {a, b, b + around, a, b + around, a + around}) mesh.indices.push_back(index);
    }
  }
}

void add_ball(SurfaceMesh& mesh, const Eigen::Vector2f& center, float radius, uint8_t material) {
  constexpr uint32_t kRings = 17;
  constexpr uint32_t kAround = 32;
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const Eigen::Vector3f middle(center.x(), center.y(), static_cast<float>(kTableDepth) - radius);
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    const float polar = std::numbers::pi_v<float> * (static_cast<float>(ring) / (kRings - 1) - 0.5f);
    for (uint32_t i = 0; i < kAround; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
      const Eigen::Vector3f normal(std::cos(polar) * std::cos(angle), std::cos(polar) * std::sin(angle),
                                   std::sin(polar));
      mesh.vertices.push_back(middle + radius * normal);
      mesh.normals.push_back(normal);
      mesh.materials.push_back(material);
    }
  }
  join_rings(mesh, first, kRings, kAround);
}

std::vector<Material> make_materials(Shader shader, Appearance appearance) {
  const bool second = shader == Shader::second_subject;
  std::vector<Material> materials(kMaterialCount);
  for (int label = 1; label <= kColorCount; ++label) {
    materials[label] = {.albedo = glove_albedos(shader)[label],
                        .gloss = second ? 0.06f : 0.02f,
                        .shininess = second ? 35.0f : 12.0f,
                        .pattern = second ? 0.10f : 0.0f,
                        .pattern_size = 0.0012f};
  }
  materials[kSkin] = {.albedo = {0.40f, 0.23f, 0.15f}, .gloss = 0.03f, .pattern = 0.05f, .pattern_size = 0.008f};
  if (appearance == Appearance::skin) std::fill_n(&materials[1], kColorCount, materials[kSkin]);
  materials[kTable] = {.albedo = {0.42f, 0.38f, 0.33f}, .pattern = 0.06f, .pattern_size = 0.02f};
  materials[kFloor] = {.albedo = {0.35f, 0.35f, 0.35f}, .pattern = 0.15f, .pattern_size = 0.05f};
  materials[kClutterRed] = {.albedo = {0.45f, 0.07f, 0.05f}, .gloss = 0.04f};
  materials[kClutterGreen] = {.albedo = {0.06f, 0.42f, 0.12f}, .gloss = 0.04f};
  materials[kClutterBlue] = {.albedo = {0.05f, 0.09f, 0.42f}, .gloss = 0.04f};
  materials[kClutterYellow] = {.albedo = {0.48f, 0.40f, 0.07f}, .gloss = 0.04f};
  materials[kClutterWhite] = {.albedo = {0.50f, 0.50f, 0.48f}, .gloss = 0.02f};
  return materials;
}

/// Half axes and center of the cuff's end in the forearm's frame, whose +z leads away from the hand.
struct CuffEnd {
  Eigen::Vector2f center;
  Eigen::Vector2f half_axes;
  float z;
};

CuffEnd find_cuff_end(const PosedHand& hand) {
  const Eigen::Isometry3f T_forearm_hand = hand.T_hand_joint[kForearmJoint].inverse().cast<float>();
  float z_end = 0;
  for (const Eigen::Vector3f& vertex : hand.vertices) z_end = std::max(z_end, (T_forearm_hand * vertex).z());
  Eigen::AlignedBox2f box;
  for (const Eigen::Vector3f& vertex : hand.vertices) {
    const Eigen::Vector3f p_forearm = T_forearm_hand * vertex;
    if (p_forearm.z() > z_end - 0.004f) box.extend(p_forearm.head<2>());
  }
  return {box.center(), box.sizes() / 2, z_end};
}

}  // namespace

Scene make_scene(const SceneConfig& config) {
  Scene scene{.surroundings = {}, .materials = make_materials(config.shader, config.appearance)};
  SurfaceMesh& mesh = scene.surroundings;
  if (config.clutter) {
    add_box(mesh, {-0.34f, -0.24f}, {0.13f, 0.09f, 0.045f}, 20, kClutterRed);
    add_box(mesh, {0.36f, 0.16f}, {0.10f, 0.14f, 0.03f}, -15, kClutterYellow);
    add_box(mesh, {0.30f, -0.28f}, {0.21f, 0.15f, 0.01f}, 8, kClutterWhite);
    add_ball(mesh, {-0.38f, 0.10f}, 0.022f, kClutterGreen);
    add_ball(mesh, {0.16f, -0.30f}, 0.025f, kClutterBlue);
    add_ball(mesh, {-0.20f, -0.30f}, 0.020f, kClutterYellow);
  }
  if (config.clutter_in_volume) add_box(mesh, {0.27f, 0.02f}, {0.07f, 0.07f, 0.16f}, 30, kClutterGreen);
  // Seen from the camera, normals point to -z: edge_u x edge_v = (+y) x (+x).
  add_quad(mesh, {-0.47f, -0.39f, static_cast<float>(kTableDepth)}, {0, 0.74f, 0}, {1.0f, 0, 0}, kTable);
  add_quad(mesh, {-3, -3, static_cast<float>(kFloorDepth)}, {0, 6, 0}, {6, 0, 0}, kFloor);
  return scene;
}

SurfaceMesh make_forearm(const PosedHand& hand) {
  constexpr uint32_t kRings = 8;
  constexpr uint32_t kAround = 32;
  constexpr float kLength = 0.20f;       // m
  constexpr float kInsideCuff = 0.010f;  // m
  const CuffEnd cuff = find_cuff_end(hand);
  SurfaceMesh mesh;
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    const float along = static_cast<float>(ring) / (kRings - 1);
    const Eigen::Vector2f half_axes = cuff.half_axes * (0.90f + 0.25f * along);  // thicker towards the elbow
    for (uint32_t i = 0; i < kAround; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
      const Eigen::Vector2f direction(std::cos(angle), std::sin(angle));
      const Eigen::Vector2f p = cuff.center + half_axes.cwiseProduct(direction);
      mesh.vertices.emplace_back(p.x(), p.y(), cuff.z - kInsideCuff + along * (kLength + kInsideCuff));
      const Eigen::Vector2f normal = direction.cwiseQuotient(half_axes).normalized();
      mesh.normals.emplace_back(normal.x(), normal.y(), 0.0f);
      mesh.materials.push_back(kSkin);
    }
  }
  join_rings(mesh, 0, kRings, kAround);
  // The far end is closed by a fan; the near end lies inside the glove.
  const uint32_t last_ring = (kRings - 1) * kAround;
  for (uint32_t i = 1; i + 1 < kAround; ++i)
    for (const uint32_t index : {last_ring, last_ring + i, last_ring + i + 1}) mesh.indices.push_back(index);
  return mesh;
}

}  // namespace glovebench::render
