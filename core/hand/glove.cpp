#include "core/hand/glove.h"

#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

constexpr double kSplit = 0.05;           // weight of front/back and radial/ulnar in the palm's scores
constexpr double kCuffSlope = 1 / 0.005;  // 1/m
constexpr double kCuffStart = 0.002;      // m past the wrist joint
constexpr double kPalmHalfWidth = 0.03;   // m
constexpr double kWeightRamp = 0.015;     // m over which the weights change from one segment to the next
/// A patch that grows needs this weight: less than both segments have at a border that is shifted by
/// kMostBorderShift.
constexpr double kGrowingWeight = 0.3;

/// Points that weigh as much as the layout by weights, away from the cuff.
constexpr double kOwnVotes = 20;

/// The votes plus a small fraction that differs between vertices and patches. Without it three patches could tie,
/// and one of them would get a region without area.
double points_untied(const PatchVotes& votes) {
  constexpr double kLittle = 1e-3;
  uint32_t hash = (votes.vertex * kPatchCount + votes.patch + 1) * 2654435761U;
  hash = (hash ^ hash >> 15) * 2246822519U;
  hash ^= hash >> 13;
  return votes.points + kLittle * hash / std::numeric_limits<uint32_t>::max();
}

/// Joint whose weight makes a vertex part of the patch; finger segments and thenar only.
constexpr std::array<int, 15> kSegmentJoint = {2, 3, 6, 7, 8, 11, 12, 13, 16, 17, 18, 21, 22, 23, 1};
/// Number of segments from the palm.
constexpr std::array<int, 15> kSegmentLevel = {2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1};
constexpr int kLevels = 3;

/// What a shift of the borders adds to a patch's score. A shift towards the fingertips lets inner patches grow. A
/// shift towards the wrist lets outer ones grow.
double growth(double border_shift, int level, double weight) {
  const int levels = border_shift > 0 ? kLevels - level : level;
  return std::abs(border_shift) / kWeightRamp * levels * std::min(1.0, weight / kGrowingWeight);
}

/// A point on the cut mesh as a blend of the original triangle's corners.
struct Corner {
  uint32_t vertex;              // in the cut mesh
  Eigen::Vector3d barycentric;  // in the triangle that is being cut
};

class PatchCutter {
 public:
  PatchCutter(const RiggedMesh& mesh, const std::vector<PatchScores>& scores) : mesh_(mesh), scores_(scores) {}

  GlovedMesh cut() {
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) cut_triangle(t);
    return std::move(result_);
  }

 private:
  /// Where the largest score changes along an edge, from its smaller vertex number to its larger one.
  struct Border {
    double t;
    int from;
    int to;
    uint32_t vertex;
  };
  using Edge = std::pair<uint32_t, uint32_t>;

  static int largest(const PatchScores& s) {
    return static_cast<int>(std::max_element(s.begin(), s.end()) - s.begin());
  }

  uint32_t add_vertex(const Eigen::Vector3d& p, const std::array<float, kJointCount>& weights) {
    result_.vertices.push_back(p);
    result_.influences.push_back(strongest_four(weights));
    return static_cast<uint32_t>(result_.vertices.size() - 1);
  }

  static Influence strongest_four(std::array<float, kJointCount> weights) {
    Influence influence;
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
      const auto best = std::max_element(weights.begin(), weights.end());
      if (*best <= 0) break;
      influence.joint[i] = static_cast<uint8_t>(best - weights.begin());
      influence.weight[i] = *best;
      sum += *best;
      *best = 0;
    }
    for (float& w : influence.weight) w /= sum;
    return influence;
  }

  /// A vertex at a blend of original vertices; weights are blended alike.
  uint32_t blend(std::span<const uint32_t> vertices, std::span<const double> shares) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    std::array<float, kJointCount> weights{};
    for (size_t i = 0; i < vertices.size(); ++i) {
      p += shares[i] * mesh_.vertices[vertices[i]];
      const Influence& influence = mesh_.influences[vertices[i]];
      for (int k = 0; k < 4; ++k)
        weights[influence.joint[k]] += static_cast<float>(shares[i]) * influence.weight[k];
    }
    return add_vertex(p, weights);
  }

  uint32_t original(uint32_t v) {
    const auto [it, is_new] = originals_.try_emplace(v, 0);
    if (is_new) {
      const std::array<double, 1> all = {1.0};
      it->second = blend(std::span(&v, 1), all);
    }
    return it->second;
  }

  const std::vector<Border>& borders(const Edge& edge) {
    const auto [it, is_new] = borders_.try_emplace(edge);
    if (!is_new) return it->second;
    const PatchScores &a = scores_[edge.first], &b = scores_[edge.second];
    double t = 0;
    for (int current = largest(a); current != largest(b);) {
      // The next patch is the one whose line crosses the current one first.
      Border next{2.0, current, current, 0};
      for (int g = 0; g < kPatchCount; ++g) {
        const double gain = (b[g] - b[current]) - (a[g] - a[current]);
        if (g == current || gain <= 0) continue;
        const double crossing = (a[current] - a[g]) / gain;
        if (crossing >= t && crossing < next.t) next = {crossing, current, g, 0};
      }
      check(next.t <= 1.0, "the largest score changes on the edge");
      const std::array<uint32_t, 2> ends = {edge.first, edge.second};
      const std::array<double, 2> shares = {1 - next.t, next.t};
      next.vertex = blend(ends, shares);
      it->second.push_back(next);
      t = next.t;
      current = next.to;
    }
    return it->second;
  }

  /// Where three patches meet inside the triangle: the point where their scores are equal and largest.
  std::optional<Eigen::Vector3d> meeting_point(const std::array<uint32_t, 3>& t, int g, int h, int i) const {
    Eigen::Matrix3d system;
    for (int c = 0; c < 3; ++c) {
      const PatchScores& s = scores_[t[c]];
      system(0, c) = s[g] - s[h];
      system(1, c) = s[g] - s[i];
      system(2, c) = 1;
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> lu(system);
    if (!lu.isInvertible()) return {};
    const Eigen::Vector3d b = lu.solve(Eigen::Vector3d(0, 0, 1));
    if (b.minCoeff() <= 0) return {};
    const auto score = [&](int patch) {
      return b[0] * scores_[t[0]][patch] + b[1] * scores_[t[1]][patch] + b[2] * scores_[t[2]][patch];
    };
    for (int other = 0; other < kPatchCount; ++other)
      if (other != g && other != h && other != i && score(other) > score(g)) return {};
    return b;
  }

  void cut_triangle(uint32_t index) {
    const std::array<uint32_t, 3>& t = mesh_.triangles[index];
    std::map<int, std::vector<Corner>> regions;  // patch -> corners of its part of the triangle
    for (int c = 0; c < 3; ++c) {
      regions[largest(scores_[t[c]])].push_back({original(t[c]), Eigen::Vector3d::Unit(c)});
      const int d = (c + 1) % 3;
      const bool forward = t[c] < t[d];
      for (const Border& border : borders(forward ? Edge{t[c], t[d]} : Edge{t[d], t[c]})) {
        Eigen::Vector3d b = Eigen::Vector3d::Zero();
        b[forward ? d : c] = border.t;
        b[forward ? c : d] = 1 - border.t;
        regions[border.from].push_back({border.vertex, b});
        regions[border.to].push_back({border.vertex, b});
      }
    }
    if (regions.size() > 2) add_meeting_points(t, regions);
    for (const auto& [patch, corners] : regions) add_polygon(corners, patch);
  }

  void add_meeting_points(const std::array<uint32_t, 3>& t, std::map<int, std::vector<Corner>>& regions) {
    for (int g = 0; g < kPatchCount; ++g) {
      for (int h = g + 1; h < kPatchCount; ++h) {
        for (int i = h + 1; i < kPatchCount; ++i) {
          const std::optional<Eigen::Vector3d> b = meeting_point(t, g, h, i);
          if (!b) continue;
          const std::array<double, 3> shares = {(*b)[0], (*b)[1], (*b)[2]};
          const uint32_t v = blend(t, shares);
          for (const int patch : {g, h, i}) regions[patch].push_back({v, *b});
        }
      }
    }
  }

  /// Each region is convex: its corners in counter-clockwise order, as a fan.
  void add_polygon(std::vector<Corner> corners, int patch) {
    check(corners.size() >= 3, "a patch's part of a triangle is a polygon");
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const Corner& c : corners) center += c.barycentric / static_cast<double>(corners.size());
    const auto angle = [&](const Corner& c) {
      return std::atan2(c.barycentric[2] - center[2], c.barycentric[1] - center[1]);
    };
    std::stable_sort(corners.begin(), corners.end(),
                     [&](const Corner& a, const Corner& b) { return angle(a) < angle(b); });
    const uint8_t label = patch_labels()[patch];
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      result_.triangles.push_back(
          {{corners[0].vertex, corners[i].vertex, corners[i + 1].vertex}, label, static_cast<uint8_t>(patch)});
    }
  }

  const RiggedMesh& mesh_;
  const std::vector<PatchScores>& scores_;
  GlovedMesh result_;
  std::map<uint32_t, uint32_t> originals_;
  std::map<Edge, std::vector<Border>> borders_;
};

}  // namespace

const std::array<std::string_view, kPatchCount>& patch_names() {
  static constexpr std::array<std::string_view, kPatchCount> names = {
      "thumb_proximal",  "thumb_distal",        "index_proximal",      "index_intermediate", "index_distal",
      "middle_proximal", "middle_intermediate", "middle_distal",       "ring_proximal",      "ring_intermediate",
      "ring_distal",     "little_proximal",     "little_intermediate", "little_distal",      "thenar",
      "palm_radial",     "palm_ulnar",          "back_radial",         "back_ulnar",         "cuff"};
  return names;
}

const std::array<uint8_t, kPatchCount>& patch_labels() {
  static constexpr std::array<uint8_t, kPatchCount> labels = {
      1,  2,      // thumb proximal, distal
      3,  4,  5,  // index
      6,  7,  8,  // middle
      2,  1,  3,  // ring
      9,  10, 6,  // little
      9,          // thenar
      10, 4,      // palm radial, ulnar
      8,  5,      // back radial, ulnar
      7,          // cuff
  };
  return labels;
}

const std::array<uint32_t, kAngleCount>& patches_moved() {
  static const std::array<uint32_t, kAngleCount> moved = [] {
    constexpr auto bit = [](Patch p) { return uint32_t{1} << p; };
    std::array<uint32_t, kAngleCount> m{};
    m[kWristFlexion] = m[kWristAbduction] = bit(kCuff);
    m[kThumbIpFlexion] = bit(kThumbDistal);
    m[kThumbMcpFlexion] = m[kThumbIpFlexion] | bit(kThumbProximal);
    m[kThumbCmcAbduction] = m[kThumbCmcFlexion] = m[kThumbMcpFlexion] | bit(kThenar);
    for (int finger = 0; finger < 4; ++finger) {
      const int angle = kIndexMcpAbduction + 4 * finger;
      const auto proximal = static_cast<Patch>(kIndexProximal + 3 * finger);
      m[angle + 3] = bit(static_cast<Patch>(proximal + 2));
      m[angle + 2] = m[angle + 3] | bit(static_cast<Patch>(proximal + 1));
      m[angle] = m[angle + 1] = m[angle + 2] | bit(proximal);
    }
    return m;
  }();
  return moved;
}

std::vector<PatchScores> patch_scores(const RiggedMesh& mesh, double border_shift) {
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  const double z_wrist = mesh.T_mesh_joint[kWristJoint].translation().z();
  const double x_middle = mesh.T_mesh_joint[joint_index("middle-finger-phalanx-proximal")].translation().x();
  std::vector<PatchScores> scores(mesh.vertices.size());
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Influence& influence = mesh.influences[v];
    double palm = 1;
    for (size_t s = 0; s < kSegmentJoint.size(); ++s) {
      const double weight = influence.weight_of(kSegmentJoint[s]);
      scores[v][s] = weight + growth(border_shift, kSegmentLevel[s], weight);
      palm -= weight;
    }
    palm += growth(border_shift, 0, palm);
    const double dorsal = kSplit * normals[v].y();
    const double ulnar = kSplit * (mesh.vertices[v].x() - x_middle - border_shift) / kPalmHalfWidth;
    scores[v][kPalmRadial] = palm - dorsal - ulnar;
    scores[v][kPalmUlnar] = palm - dorsal + ulnar;
    scores[v][kBackRadial] = palm + dorsal - ulnar;
    scores[v][kBackUlnar] = palm + dorsal + ulnar;
    scores[v][kCuff] =
        1 + growth(border_shift, 0, 1) + kCuffSlope * (mesh.vertices[v].z() - z_wrist - kCuffStart + border_shift);
  }
  return scores;
}

void add_votes(std::vector<PatchScores>& scores, std::span<const PatchVotes> votes) {
  std::vector<double> points(scores.size());
  for (const PatchVotes& vote : votes) points.at(vote.vertex) += points_untied(vote);
  for (size_t v = 0; v < scores.size(); ++v)
    for (double& score : scores[v]) score *= kOwnVotes / (kOwnVotes + points[v]);
  for (const PatchVotes& vote : votes)
    scores[vote.vertex][vote.patch] += points_untied(vote) / (kOwnVotes + points[vote.vertex]);
}

GlovedMesh cut_patches(const RiggedMesh& mesh, const std::vector<PatchScores>& scores) {
  return PatchCutter(mesh, scores).cut();
}

}  // namespace glovebench
