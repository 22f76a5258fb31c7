#include <pcl/point_types.h>
#include <pcl/registration/icp.h>

#include "bench/peers/peers.h"

namespace glovebench::bench {
namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

Cloud::Ptr cloud_of(std::span<const LabeledPoint> points) {
  auto cloud = pcl::make_shared<Cloud>();
  for (const LabeledPoint& point : points) cloud->emplace_back(point.p.x(), point.p.y(), point.p.z());
  return cloud;
}

Cloud::Ptr centers_of(const Surface& surface) {
  auto cloud = pcl::make_shared<Cloud>();
  for (uint8_t label = 0; label <= kColorCount; ++label) {
    for (const Surface::Face& face : surface.faces(label)) {
      const Eigen::Vector3f center = (face.a + face.b + face.c) / 3;
      cloud->emplace_back(center.x(), center.y(), center.z());
    }
  }
  return cloud;
}

/// Says how many iterations it took.
struct CountedIcp : pcl::IterativeClosestPoint<Point, Point> {
  int iterations() const { return nr_iterations_; }
};

/// In the hand frame, where the model and its tree stand still. Not its point-to-plane variant: that diverges from
/// a coarse pose.
Alignment align(const Surface& surface, std::span<const LabeledPoint> points,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
  CountedIcp icp;
  icp.setInputSource(cloud_of(points));
  icp.setInputTarget(centers_of(surface));
  icp.setMaximumIterations(config.max_iterations);
  // Its error is the mean square: it changes by twice the share.
  icp.setEuclideanFitnessEpsilon(2 * config.convergence_share);
  Cloud aligned;
  icp.align(aligned, T_camera_hand_coarse.inverse().matrix().cast<float>());
  Alignment result;
  result.status = icp.hasConverged() ? AlignmentStatus::converged : AlignmentStatus::not_converged;
  const Eigen::Isometry3f T_hand_camera(icp.getFinalTransformation());
  result.T_camera_hand = T_hand_camera.inverse().cast<double>();
  result.points = static_cast<int>(points.size());
  result.iterations = icp.iterations();
  return result;
}

}  // namespace

const AlignPeer kPcl = align;

}  // namespace glovebench::bench
