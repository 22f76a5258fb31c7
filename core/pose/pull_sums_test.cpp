#include "core/pose/pull_sums.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/pose/test_alignment.h"
#include "core/test_simd.h"

namespace glovebench {
namespace {

void expect_equal(const NormalEquations& a, const NormalEquations& b) {
  // The shares of angles are sums of floats.
  EXPECT_LT((a.H - b.H).cwiseAbs().maxCoeff(), 1e-6 * a.H.cwiseAbs().maxCoeff());
  EXPECT_LT((a.g - b.g).cwiseAbs().maxCoeff(), 1e-6 * a.g.cwiseAbs().maxCoeff());
}

TEST(PullSums, of_single_pulls_equal_plain_ones) {
  const PosedHand hand = posed();
  const std::array<Screw, kAngleCount> screws = angle_screws(test_hand(), hand);
  const std::vector<BodyShares> shares = body_shares(test_hand());
  PlainPullSums plain(screws);
  PullSums fast(screws);
  RandomStream random(1, "pull sums", 0, "single");
  for (size_t v = 0; v < hand.vertices.size(); v += 3) {
    const Pull pull{hand.vertices[v].cast<double>(), random_direction(random), random.uniform(-9, 9),
                    random.uniform(0, 2)};
    plain.add(pull, shares[v]);
    fast.add(pull, shares[v]);
  }
  expect_equal(plain.equations(), fast.equations());
}

TEST(PullSums, of_points_equal_plain_ones_and_are_the_same_on_each_instruction_set) {
  const PosedHand hand = posed();
  const std::array<Screw, kAngleCount> screws = angle_screws(test_hand(), hand);
  const std::vector<BodyShares> shares = body_shares(test_hand());
  const std::vector<FaceBodies> faces = face_bodies(test_hand(), shares);
  const Surface surface(test_hand(), hand, {0.1f, 0.2f, 0.6f});
  RandomStream random(1, "pull sums", 0, "points");
  RecycledVector<LabeledPoint> points;
  for (const Triangle& triangle : test_hand().triangles()) {
    // On corners, edges and faces, on the surface and off it.
    Eigen::Vector3f p = Eigen::Vector3f::Zero();
    for (const uint32_t corner : triangle.vertices) p += hand.vertices[corner] / 3;
    if (points.size() % 5 == 0) p = hand.vertices[triangle.vertices[0]];
    if (points.size() % 3 != 0) p += (0.006 * random_direction(random)).cast<float>();
    points.push_back({p, patch_labels()[triangle.patch]});
  }
  while (points.size() % 8 != 3) points.pop_back();  // the last vector is not full
  RecycledVector<ClosestPoint> closest = closest_points_plain(points, surface);
  closest[1].face = -1;
  for (const double tangential : {0.0, 0.3}) {
    const PullWeights weights{.tukey_mm = 9, .tangential = tangential};
    PlainPullSums plain(screws);
    plain.add({points, closest, surface}, test_hand().triangles(), shares, weights);
    std::optional<NormalEquations> before;
    on_each_instruction_set([&] {
      PullSums fast(screws);
      fast.add({points, closest, surface}, faces, weights);
      const NormalEquations equations = fast.equations();
      expect_equal(plain.equations(), equations);
      if (before) {
        EXPECT_TRUE(equations.H == before->H && equations.g == before->g);
      }
      before = equations;
    });
  }
}

}  // namespace
}  // namespace glovebench
