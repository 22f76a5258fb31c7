#include "render/subjects/subject.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "ci/build_paths.h"
#include "core/test_error.h"
#include "render/rgbd_renderer.h"
#include "render/subjects/surface_net.h"
#include "render/test_hand.h"

namespace glovebench::render {
namespace {

std::shared_ptr<const HandModel> tracker_hand() {
  return {&test_hand(), [](const HandModel*) {}};
}

Subject subject(int number) { return make_subject(number, build_paths::hand_mesh(), tracker_hand()); }

TEST(Subject, TheFirstTwoAreTheTrackersMesh) {
  EXPECT_EQ(subject(1).hash(), test_hand().hash());
  EXPECT_EQ(subject(2).hash(), HandModel::load(build_paths::hand_mesh(), Side::right, second_subject()).hash());
  const JointPoses T = subject(2).joints(test_posture());
  EXPECT_TRUE(T[9].isApprox(subject(2).pose(test_posture()).T_hand_joint[9], 0));
}

TEST(Subject, RefusesANumberThatNoneHas) {
  for (const int number : {0, 23, -1}) {
    EXPECT_THAT(thrown_by([&] { subject(number); }),
                testing::AllOf(testing::HasSubstr("found " + std::to_string(number)),
                               testing::HasSubstr("expected 1 to 22")));
  }
}

TEST(SubjectLong, EachIsAnotherHandOfOneClosedSurfaceWithoutHandles) {
  std::set<std::string> hashes = {subject(1).hash(), subject(2).hash()};
  for (int number = kFirstCapsuleSubject; number <= kSubjectCount; ++number) {
    const Subject hand = subject(number);
    hashes.insert(hand.hash());
    std::vector<std::array<uint32_t, 3>> corners;
    std::set<std::pair<uint32_t, uint32_t>> edges;
    std::map<uint32_t, uint32_t> next;  // towards the representative of a vertex's piece
    const auto piece = [&next](uint32_t v) {
      while (next.try_emplace(v, v).first->second != v) v = next[v] = next[next[v]];
      return v;
    };
    for (const Triangle& t : hand.triangles()) {
      corners.push_back(t.vertices);
      EXPECT_LT(t.patch, kPatchCount);
      for (int i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax({t.vertices[i], t.vertices[(i + 1) % 3]});
        edges.emplace(a, b);
        next[piece(a)] = piece(b);
      }
    }
    EXPECT_TRUE(is_closed(corners)) << number;
    const auto pieces = std::ranges::count_if(next, [](const auto& entry) { return entry.first == entry.second; });
    EXPECT_EQ(pieces, 1) << number;
    EXPECT_EQ(std::ssize(next) - std::ssize(edges) + std::ssize(corners), 2) << "Euler, subject " << number;
  }
  EXPECT_EQ(hashes.size(), static_cast<size_t>(kSubjectCount));
}

/// Areas of equal truth (4-neighborhood) in an image of zero and others.
int count_areas(const LabelImage& labels, bool glove) {
  Image<uint8_t> seen(labels.width(), labels.height());
  int areas = 0;
  for (int v0 = 0; v0 < labels.height(); ++v0) {
    for (int u0 = 0; u0 < labels.width(); ++u0) {
      if (seen(u0, v0) != 0 || (labels(u0, v0) > 0) != glove) continue;
      ++areas;
      std::vector<std::pair<int, int>> open = {{u0, v0}};
      seen(u0, v0) = 1;
      while (!open.empty()) {
        const auto [u, v] = open.back();
        open.pop_back();
        for (const auto& [du, dv] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
          if (!labels.contains(u + du, v + dv) || seen(u + du, v + dv) != 0) continue;
          if ((labels(u + du, v + dv) > 0) != glove) continue;
          seen(u + du, v + dv) = 1;
          open.emplace_back(u + du, v + dv);
        }
      }
    }
  }
  return areas;
}

TEST(SubjectLong, IsOnePieceWithoutHoles) {
  for (const int number : {3, 11, 22}) {
    const Subject hand = subject(number);
    RgbdRenderer renderer(synthetic_calibration(), hand, {.shader = shader_of(number), .clutter = false});
    for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0.1, 0, 0), Eigen::Vector3d(0.1, 3.1, 0)}) {
      const RgbdImages images =
          renderer.render(hand.pose(CapsuleHand::rest_posture()), test_pose({0, 0, 0.6}, turn), {});
      EXPECT_EQ(count_areas(images.label, true), 1) << number;
      EXPECT_EQ(count_areas(images.label, false), 1) << number;
      std::set<int> colors(images.label.begin(), images.label.end());
      EXPECT_GE(colors.size(), 9u) << number;
    }
  }
}

}  // namespace
}  // namespace glovebench::render
