#include "render/subjects/capsule_hand.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>
#include <thread>

#include "core/base/math.h"
#include "core/base/random.h"
#include "render/subjects/capsule_glove.h"
#include "render/subjects/capsule_skeleton.h"
#include "render/subjects/subject.h"
#include "render/subjects/surface_net.h"
#include "render/test_hand.h"

namespace glovebench::render {
namespace {

constexpr int kOtherSeed = 11;

CapsuleHand make_hand(uint64_t seed, Side side = Side::right) {
  return CapsuleHand(seed, side, test_hand().skeleton());
}

const CapsuleHand& hand_of(int seed) {
  static std::map<int, CapsuleHand> hands;
  const auto known = hands.find(seed);
  return known != hands.end() ? known->second : hands.emplace(seed, make_hand(seed)).first->second;
}

Posture fist() {
  return posture_from_degrees({0, 0, 25, 35, 40, 50, 0, 80, 95, 60, 0, 82, 98, 60, 0, 82, 98, 60, 0, 80, 95, 55});
}

Posture random_posture(int number) {
  RandomStream random(1, "capsule hand test", number, "posture");
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[a];
    posture[a] = radians_from_degrees(random.uniform(0.9 * info.min_deg, 0.9 * info.max_deg));
  }
  return posture;
}

std::vector<Posture> postures() {
  return {Posture::Zero(), CapsuleHand::rest_posture(), fist(), random_posture(1), random_posture(2)};
}

std::vector<std::array<uint32_t, 3>> corners(const CapsuleHand& hand) {
  std::vector<std::array<uint32_t, 3>> result;
  for (const Triangle& t : hand.triangles()) result.push_back(t.vertices);
  return result;
}

double litres(const std::vector<Triangle>& triangles, const PosedHand& hand) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const auto p = [&](int i) { return hand.vertices[t.vertices[i]].cast<double>().eval(); };
    sum += p(0).dot(p(1).cross(p(2))) / 6;
  }
  return 1000 * sum;
}

TEST(CapsuleHand, IsClosedAndHasTheLayoutOfTheTrackersGlove) {
  for (const int seed : {3, 12}) {
    for (const Side side : {Side::right, Side::left}) {
      const CapsuleHand hand = make_hand(seed, side);
      EXPECT_TRUE(is_closed(corners(hand)));
      const double volume = litres(hand.triangles(), hand.pose(Posture::Zero()));
      EXPECT_GT(volume, 0.2);
      EXPECT_LT(volume, 0.8);
      std::set<int> patches;
      for (const Triangle& t : hand.triangles()) {
        patches.insert(t.patch);
        ASSERT_EQ(t.label, patch_labels()[t.patch]);
      }
      EXPECT_EQ(patches.size(), static_cast<size_t>(kPatchCount));
    }
  }
}

TEST(CapsuleHand, PatchesLieWhereTheTrackersAre) {
  // Each patch's center relative to that of the tracker's mesh, in hand frames that both hands place alike. Hands
  // differ in size by up to 15%.
  const auto centers = [](const std::vector<Triangle>& triangles, const PosedHand& hand) {
    std::array<Eigen::Vector3d, kPatchCount> sum;
    sum.fill(Eigen::Vector3d::Zero());
    std::array<double, kPatchCount> area{};
    for (const Triangle& t : triangles) {
      const auto p = [&](int i) { return hand.vertices[t.vertices[i]].cast<double>().eval(); };
      const double a = (p(1) - p(0)).cross(p(2) - p(0)).norm();
      sum[t.patch] += a * (p(0) + p(1) + p(2)) / 3;
      area[t.patch] += a;
    }
    for (int p = 0; p < kPatchCount; ++p) sum[p] /= area[p];
    return sum;
  };
  const auto expected = centers(test_hand().triangles(), test_hand().pose(Posture::Zero()));
  for (const int seed : {3, 4, kOtherSeed}) {
    const auto found = centers(hand_of(seed).triangles(), hand_of(seed).pose(Posture::Zero()));
    for (int p = 0; p < kPatchCount; ++p)
      EXPECT_LT((found[p] - expected[p]).norm(), 0.020) << "patch " << p << " of seed " << seed;
  }
}

TEST(CapsuleHand, LiesOnTheFieldOfItsPosedCapsules) {
  for (const int seed : {3, kOtherSeed}) {
    const CapsuleHand& hand = hand_of(seed);
    for (const Posture& posture : postures()) {
      const PosedHand posed = hand.pose(posture);
      const std::vector<Capsule> placed = place_capsules(hand.capsules(), posed.T_hand_joint, posture);
      int off = 0;
      double most = 0;
      for (size_t v = 0; v < posed.vertices.size(); ++v) {
        if (std::isnan(hand.levels()[v])) continue;
        const double value = hand.field_at(v, placed, posed.vertices[v].cast<double>()).value;
        most = std::max(most, std::abs(value - hand.levels()[v]));
        off += std::abs(value - hand.levels()[v]) > 2e-5;
      }
      EXPECT_LT(most, 0.0005);
      EXPECT_LT(off, 10) << "of " << posed.vertices.size();
    }
  }
}

TEST(CapsuleHand, ItsFrameIsPlacedByItsOwnJoints) {
  for (int seed = kFirstCapsuleSubject; seed <= kSubjectCount; ++seed) {
    const HandDimensions dimensions = draw_dimensions(seed);
    const JointPoses T = make_skeleton(dimensions, test_hand().skeleton(), seed).pose(Posture::Zero());
    const Eigen::Vector3d wrist = T[kWristJoint].translation(), mcp = T[11].translation();
    EXPECT_LT((wrist + mcp).norm(), 1e-12);
    EXPECT_NEAR(wrist.x(), 0, 1e-12);
    EXPECT_NEAR(wrist.y(), 0, 1e-12);
    const Eigen::Vector3d across = T[21].translation() - T[6].translation();  // index to little MCP
    EXPECT_NEAR(across.y(), 0, 1e-12);
    EXPECT_GT(across.x(), 0.03);
    // The thumb's zero is that of the package's mesh.
    const Eigen::Quaterniond found(T[1].linear()),
        expected(test_hand().pose(Posture::Zero()).T_hand_joint[1].linear());
    EXPECT_LT(found.angularDistance(expected), radians_from_degrees(3.01)) << "twist of the seed: two deviations";
  }
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

TEST(CapsuleHand, AnglesReproduceTheJoints) {
  const CapsuleHand& hand = hand_of(kOtherSeed);
  const HandDimensions& dimensions = hand.dimensions();
  for (int number = 0; number < 20; ++number) {
    const Posture posture = random_posture(number);
    const JointPoses T = hand.joints(posture);
    const auto place = [&](int joint) { return T[joint].translation(); };
    for (int finger = 1; finger < 5; ++finger) {
      const int mcp = 1 + 5 * finger, angle = kIndexMcpAbduction + 4 * (finger - 1);
      const Eigen::Vector3d proximal = place(mcp + 1) - place(mcp), middle = place(mcp + 2) - place(mcp + 1),
                            distal = place(mcp + 3) - place(mcp + 2);
      EXPECT_NEAR(proximal.norm(), dimensions.segments[finger][0], 1e-9);
      EXPECT_NEAR(middle.norm(), dimensions.segments[finger][1], 1e-9);
      // Abduction first, then flexion about the abducted axis: hand-computed direction of the proximal segment.
      const double a = posture[angle], f = posture[angle + 1];
      const Eigen::Vector3d direction(-std::sin(a) * std::cos(f), -std::sin(f), -std::cos(a) * std::cos(f));
      EXPECT_LT(angle_between(proximal, direction), 1e-6);
      // Hinges: the angle between segments is the flexion but for the few degrees that the seed bends them
      // sideways.
      EXPECT_NEAR(angle_between(proximal, middle), std::abs(posture[angle + 2]), radians_from_degrees(3.5));
      EXPECT_NEAR(angle_between(middle, distal), std::abs(posture[angle + 3]), radians_from_degrees(3.5));
    }
    const Eigen::Vector3d thumb_proximal = place(3) - place(2), thumb_distal = place(4) - place(3);
    EXPECT_NEAR((place(2) - place(1)).norm(), dimensions.segments[0][0], 1e-9);
    EXPECT_NEAR(angle_between(thumb_proximal, thumb_distal), std::abs(posture[kThumbIpFlexion]),
                radians_from_degrees(3.5));
    EXPECT_TRUE(hand.pose(posture).T_hand_joint[14].isApprox(T[14], 0));
  }
}

TEST(CapsuleHand, IsAsWideAsItsDimensionsSay) {
  for (const int seed : {3, 4, kOtherSeed, 22}) {
    const CapsuleHand& hand = hand_of(seed);
    const PosedHand posed = hand.pose(Posture::Zero());
    const auto place = [&](int joint) { return posed.T_hand_joint[joint].translation(); };
    double radial = 1, ulnar = -1, tip = 1, highest = -1, lowest = 1;
    for (const Triangle& t : hand.triangles()) {
      for (const uint32_t v : t.vertices) {
        const Eigen::Vector3d p = posed.vertices[v].cast<double>();
        const bool on_radial = t.patch == kPalmRadial || t.patch == kBackRadial || t.patch == kIndexProximal;
        const bool on_ulnar = t.patch == kPalmUlnar || t.patch == kBackUlnar || t.patch == kLittleProximal;
        if (on_radial && std::abs(p.z() - place(6).z()) < 0.006) radial = std::min(radial, p.x());
        if (on_ulnar && std::abs(p.z() - place(21).z()) < 0.006) ulnar = std::max(ulnar, p.x());
        if (t.patch == kMiddleDistal) tip = std::min(tip, p.z());
        const bool on_middle = t.patch == kMiddleProximal || t.patch == kMiddleIntermediate;
        if (on_middle && std::abs(p.z() - place(12).z()) < 0.002) {
          highest = std::max(highest, p.y());
          lowest = std::min(lowest, p.y());
        }
      }
    }
    const HandDimensions& dimensions = hand.dimensions();
    EXPECT_NEAR(ulnar - radial, dimensions.breadth + 2 * kGloveThickness, 0.004) << seed;
    EXPECT_NEAR(place(kWristJoint).z() - tip, dimensions.length + kGloveThickness, 0.003) << seed;
    // Folds are up to 1 mm on either side.
    EXPECT_NEAR(highest - lowest, dimensions.middle_girth[2] / std::numbers::pi + 2 * kGloveThickness, 0.002)
        << seed;
  }
}

TEST(CapsuleHand, FingersEndWhereTheirBonesAndPulpDo) {
  for (const int seed : {3, 4, kOtherSeed}) {
    const CapsuleHand& hand = hand_of(seed);
    for (const Posture& posture : postures()) {
      const PosedHand posed = hand.pose(posture);
      for (int finger = 0; finger < 5; ++finger) {
        const int joint = 3 + 5 * finger, patch = finger == 0 ? kThumbDistal : kIndexDistal + 3 * (finger - 1);
        const double length = hand.dimensions().segments[finger][2] + hand.dimensions().pulp[finger];
        double end = 0, level = 0;
        for (const Triangle& t : hand.triangles()) {
          if (t.patch != patch) continue;
          for (const uint32_t v : t.vertices) {
            const double along = -(posed.T_hand_joint[joint].inverse() * posed.vertices[v].cast<double>()).z();
            if (along > end) end = along, level = hand.levels()[v];
          }
        }
        // Vertices are 2.5 mm apart: up to 1.8 mm beside the end of a ball of 6 mm, which is 0.27 mm deep. A fold
        // beside the end may reach farther.
        EXPECT_NEAR(end, length + level, 0.0005) << "seed " << seed << ", finger " << finger;
        // The tip of the metrics lies on the segment's axis inside the finger.
        const Eigen::Vector3d tip =
            posed.T_hand_joint[joint].inverse() * posed.T_hand_joint[joint + 1].translation();
        EXPECT_LT(tip.head<2>().norm(), 1e-9);
        EXPECT_LT(-tip.z(), length - 0.005);
        EXPECT_GT(-tip.z(), length / 3);
      }
    }
  }
}

TEST(CapsuleHand, FoldsAreOneToTwoMillimetresDeep) {
  std::set<int> depths_um;
  for (const int seed : {3, 4, kOtherSeed, 22}) {
    double lowest = 1, highest = -1, mean = 0;
    int count = 0;
    for (const double level : hand_of(seed).levels()) {
      if (std::isnan(level)) continue;
      lowest = std::min(lowest, level);
      highest = std::max(highest, level);
      mean += level;
      ++count;
    }
    EXPECT_GE(highest - lowest, 0.9 * kLeastFold) << "the cuff's hem, which is smooth, may have had the highest";
    EXPECT_LE(highest - lowest, kMostFold + 1e-9);
    EXPECT_NEAR(mean / count, kGloveThickness, 0.0001);
    depths_um.insert(static_cast<int>(1e6 * (highest - lowest)));
  }
  EXPECT_EQ(depths_um.size(), 4u) << "each glove has its own";
}

/// For each border between two consecutive segments of a finger: mean distance past the joint, m.
std::vector<double> border_shifts(const CapsuleHand& hand, double& most) {
  const PosedHand rest = hand.pose(CapsuleHand::rest_posture());
  std::map<std::pair<uint32_t, uint32_t>, int> patch_of;
  for (const Triangle& t : hand.triangles())
    for (int i = 0; i < 3; ++i) patch_of[{t.vertices[i], t.vertices[(i + 1) % 3]}] = t.patch;
  std::map<int, std::vector<double>> along;
  for (const auto& [edge, patch] : patch_of) {
    const int other = patch_of.at({edge.second, edge.first});
    const int segment = other - kIndexProximal;
    if (other != patch + 1 || patch < kIndexProximal || other > kLittleDistal || segment % 3 == 0) continue;
    const Eigen::Isometry3d& T = rest.T_hand_joint[6 + 5 * (segment / 3) + segment % 3];
    along[other].push_back(-(T.inverse() * rest.vertices[edge.first].cast<double>()).z());
  }
  std::vector<double> means;
  most = 0;
  for (const auto& [patch, values] : along) {
    double mean = 0;
    for (const double value : values) {
      mean += value / static_cast<double>(values.size());
      most = std::max(most, std::abs(value));
    }
    means.push_back(mean);
  }
  return means;
}

TEST(CapsuleHand, BordersAreShiftedByUpToThreeMillimetres) {
  double most_of_all = 0;
  std::vector<std::vector<double>> shifts;
  for (const int seed : {3, 4, kOtherSeed, 22}) {
    double most = 0;
    shifts.push_back(border_shifts(hand_of(seed), most));
    ASSERT_EQ(shifts.back().size(), 8u);
    most_of_all = std::max(most_of_all, most);
  }
  // Within a triangle the ramps are interpolated, and at rest fingers are bent by 5 degrees: 0.7 mm.
  EXPECT_LE(most_of_all, kMostBorderShift + 0.0007);
  EXPECT_GE(most_of_all, 0.0015);
  double apart = 0;
  for (size_t b = 0; b < 8; ++b) apart = std::max(apart, std::abs(shifts[0][b] - shifts[1][b]));
  EXPECT_GE(apart, 0.001) << "each glove has its own";
}

TEST(CapsuleHand, PalmArchesAndThenarFollowsTheThumb) {
  const CapsuleHand& hand = hand_of(4);
  const PosedHand open = hand.pose(Posture::Zero());
  Posture grasp = Posture::Zero();
  grasp[kRingMcpFlexion] = grasp[kLittleMcpFlexion] = radians_from_degrees(80);
  Posture opposed = Posture::Zero();
  opposed[kThumbCmcAbduction] = radians_from_degrees(50);
  const auto travel = [&](const PosedHand& posed, int patch) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Triangle& t : hand.triangles()) {
      if (t.patch != patch) continue;
      for (const uint32_t v : t.vertices) sum += (posed.vertices[v] - open.vertices[v]).cast<double>(), ++count;
    }
    return Eigen::Vector3d(sum / count);
  };
  EXPECT_LT(travel(hand.pose(grasp), kPalmUlnar).y(), -0.0003) << "to the palmar side";
  EXPECT_LT(travel(hand.pose(grasp), kThumbDistal).norm(), 1e-9);
  EXPECT_GT(travel(hand.pose(opposed), kThenar).norm(), 0.003);
  EXPECT_LT(travel(hand.pose(opposed), kPalmUlnar).norm(), 0.001);
}

TEST(CapsuleHand, FingersThatTouchDoNotGrowTogether) {
  // In a fist each fingertip stays as thick as its capsule and the glove.
  const CapsuleHand& hand = hand_of(4);
  const PosedHand closed = hand.pose(fist());
  const std::vector<Capsule> placed = place_capsules(hand.capsules(), closed.T_hand_joint, fist());
  for (int finger = 1; finger < 5; ++finger) {
    const int joint = 3 + 5 * finger, patch = kIndexDistal + 3 * (finger - 1);
    const auto& all = hand.capsules();
    const auto own =
        std::find_if(all.begin(), all.end(), [joint](const HandCapsule& c) { return c.a.joint == joint; });
    double most = 0;
    for (const Triangle& t : hand.triangles()) {
      if (t.patch != patch) continue;
      for (const uint32_t v : t.vertices) {
        const Eigen::Vector3d p = closed.vertices[v].cast<double>();
        if (-(closed.T_hand_joint[joint].inverse() * p).z() < 0.010) continue;  // the joint's crease
        const double distance = distance_to(placed[own - all.begin()], p).value;
        most = std::max(most, std::abs(distance - hand.levels()[v]));
      }
    }
    EXPECT_LT(most, 0.0005) << "finger " << finger;
    EXPECT_GT(most, 0) << "finger " << finger;
  }
}

TEST(CapsuleHand, SameSeedSameBytesInEveryThread) {
  EXPECT_EQ(make_hand(3).hash(), hand_of(3).hash());
  EXPECT_NE(hand_of(4).hash(), hand_of(3).hash());
  EXPECT_NE(make_hand(3, Side::left).hash(), hand_of(3).hash());
  const PosedHand expected = hand_of(3).pose(fist());
  std::vector<PosedHand> found(4);
  std::vector<std::thread> threads;
  for (PosedHand& posed : found) threads.emplace_back([&posed] { posed = hand_of(3).pose(fist()); });
  for (std::thread& thread : threads) thread.join();
  for (const PosedHand& posed : found) EXPECT_TRUE(posed.vertices == expected.vertices);
}

TEST(CapsuleHand, LeftIsTheMirrorImage) {
  const CapsuleHand left = make_hand(3, Side::left);
  const PosedHand r = hand_of(3).pose(fist()), l = left.pose(fist());
  ASSERT_EQ(r.vertices.size(), l.vertices.size());
  for (size_t v = 0; v < r.vertices.size(); ++v)
    ASSERT_EQ(l.vertices[v], Eigen::Vector3f(-r.vertices[v].x(), r.vertices[v].y(), r.vertices[v].z()));
  EXPECT_EQ(l.T_hand_joint[14].translation().x(), -r.T_hand_joint[14].translation().x());
}

}  // namespace
}  // namespace glovebench::render
