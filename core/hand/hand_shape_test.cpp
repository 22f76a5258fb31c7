#include "core/hand/hand_shape.h"

#include <gtest/gtest.h>

#include <set>

#include "ci/build_paths.h"
#include "core/hand/hand_model.h"

namespace glovebench {
namespace {

const HandModel& package_hand() {
  static const HandModel model = HandModel::load(build_paths::hand_mesh());
  return model;
}

HandSizes ones_but(int size, double factor) {
  HandSizes sizes = HandShape{}.sizes;
  sizes[size] = factor;
  return sizes;
}

Eigen::Vector3d joint(const HandModel& model, int j) {
  return model.pose(Posture::Zero()).T_hand_joint[j].translation();
}
double bone(const HandModel& model, int j) { return (joint(model, j + 1) - joint(model, j)).norm(); }
/// RMS distance from the bone of the vertices that hang on a joint for nine tenths or more.
double girth(const HandModel& model, int j) {
  const PosedHand hand = model.pose(model.skeleton().bind_posture());
  const Eigen::Isometry3d T_joint_hand = hand.T_hand_joint[j].inverse();
  double sum = 0;
  int count = 0;
  for (size_t v = 0; v < hand.vertices.size(); ++v) {
    if (model.influences()[v].weight_of(j) < 0.9f) continue;
    sum += (T_joint_hand * hand.vertices[v].cast<double>()).head<2>().squaredNorm();
    ++count;
  }
  EXPECT_GT(count, 3);
  return std::sqrt(sum / count);
}

TEST(HandShape, names_each_size_once) {
  const auto& names = hand_size_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), static_cast<size_t>(kSizeCount));
  EXPECT_EQ(names[kSegmentLengths], "thumb_metacarpal_length");
  EXPECT_EQ(names[kSegmentWidths + 14], "little_distal_width");
}

TEST(HandShape, scale_scales_all_distances) {
  const HandModel larger = package_hand().stretched(ones_but(kScale, 1.1));
  for (int j = 0; j < kJointCount; ++j)
    EXPECT_LT((joint(larger, j) - 1.1 * joint(package_hand(), j)).norm(), 1e-9) << joint_name(j);
}

TEST(HandShape, a_segments_length_moves_what_hangs_on_it) {
  const HandModel longer = package_hand().stretched(ones_but(kSegmentLengths + 7, 1.1));  // middle intermediate
  EXPECT_NEAR(bone(longer, 12) / bone(package_hand(), 12), 1.1, 0.002);  // its end lies a little beside z
  EXPECT_NEAR(bone(longer, 13), bone(package_hand(), 13), 1e-9);
  EXPECT_NEAR(bone(longer, 11), bone(package_hand(), 11), 1e-9);
  EXPECT_LT((joint(longer, 8) - joint(package_hand(), 8)).norm(), 1e-9);
}

TEST(HandShape, a_segments_width_moves_skin_and_no_joint) {
  const HandModel wider = package_hand().stretched(ones_but(kSegmentWidths + 4, 1.2));  // index intermediate
  for (int j = 0; j < kJointCount; ++j)
    EXPECT_LT((joint(wider, j) - joint(package_hand(), j)).norm(), 1e-9) << joint_name(j);
  EXPECT_NEAR(girth(wider, 7) / girth(package_hand(), 7), 1.2, 0.02);  // a tenth may hang on neighbors
  EXPECT_NEAR(girth(wider, 12) / girth(package_hand(), 12), 1, 1e-6);
}

TEST(HandShape, the_palm_stretches_across_and_along_its_rays) {
  const HandModel broad = package_hand().stretched(ones_but(kPalmBreadth, 1.2));
  EXPECT_NEAR((joint(broad, 6) - joint(broad, 21)).x(),
              1.2 * (joint(package_hand(), 6) - joint(package_hand(), 21)).x(), 1e-9);
  EXPECT_NEAR(bone(broad, 6), bone(package_hand(), 6), 1e-9);

  const HandModel long_index = package_hand().stretched(ones_but(kIndexPalmLength, 1.1));
  const auto along = [](const HandModel& model, int j) {
    return (joint(model, kWristJoint) - joint(model, j)).z();
  };
  EXPECT_NEAR(along(long_index, 6), 1.1 * along(package_hand(), 6), 1e-9);
  for (const int other : {11, 16, 21}) EXPECT_NEAR(along(long_index, other), along(package_hand(), other), 1e-9);
}

TEST(HandShape, a_stretched_hand_is_the_one_that_is_loaded_with_its_shape) {
  // But for the patches, which are cut anew: their joints are equal.
  HandShape shape = second_subject();
  shape.patch_border_shift = 0;
  for (const Side side : {Side::right, Side::left}) {
    const HandModel loaded = HandModel::load(build_paths::hand_mesh(), side, shape);
    const HandModel stretched = HandModel::load(build_paths::hand_mesh(), side).stretched(shape.sizes);
    for (int j = 0; j < kJointCount; ++j)
      EXPECT_LT((joint(loaded, j) - joint(stretched, j)).norm(), 1e-9) << joint_name(j);
    EXPECT_EQ(stretched.triangles().size(), HandModel::load(build_paths::hand_mesh(), side).triangles().size());
    EXPECT_NE(stretched.hash(), package_hand().hash());
  }
}

}  // namespace
}  // namespace glovebench
