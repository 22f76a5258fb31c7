#include <embree3/rtcore.h>

#include <cmath>
#include <limits>

#include "bench/peers/peers.h"

namespace glovebench::bench {
namespace {

/// Opened once: its start is no part of a search.
RTCDevice device() {
  static const RTCDevice opened = rtcNewDevice("threads=1");
  return opened;
}

/// The nearest face so far of one point query.
struct Nearest {
  const RecycledVector<Surface::Face>& faces;
  ClosestPoint closest;
};

/// Called for each face whose box is within the query's radius.
bool consider(RTCPointQueryFunctionArguments* arguments) {
  Nearest& nearest = *static_cast<Nearest*>(arguments->userPtr);
  const Eigen::Vector3f point(arguments->query->x, arguments->query->y, arguments->query->z);
  const Eigen::Vector3f p = closest_on_triangle(point, nearest.faces[arguments->primID]);
  const float squared = (p - point).squaredNorm();
  if (!(squared < arguments->query->radius * arguments->query->radius)) return false;
  const float distance = std::sqrt(squared);
  nearest.closest = {p, distance, static_cast<int>(arguments->primID)};
  arguments->query->radius = distance;
  return true;  // the radius is another one
}

void bounds(const RTCBoundsFunctionArguments* arguments) {
  const Surface::Face& face = static_cast<const Surface::Face*>(arguments->geometryUserPtr)[arguments->primID];
  const Eigen::Vector3f low = face.a.cwiseMin(face.b).cwiseMin(face.c),
                        high = face.a.cwiseMax(face.b).cwiseMax(face.c);
  *arguments->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

/// User geometry: what has triangles of its own would call `consider` for every face of a leaf. One query at a
/// time: rtcPointQuery4, 8 and 16 are loops over it.
class EmbreeSearch : public ClosestPointPeer {
 public:
  explicit EmbreeSearch(const Surface& surface) : surface_(surface) {
    for (uint8_t label = 0; label <= kColorCount; ++label) add_scene(surface.faces(label));
  }
  ~EmbreeSearch() override {
    for (const RTCScene scene : scenes_) rtcReleaseScene(scene);
  }
  EmbreeSearch(const EmbreeSearch&) = delete;
  EmbreeSearch& operator=(const EmbreeSearch&) = delete;

  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) override {
    closest_.resize(points_hand.size());
    WarmStart warm_start;
    for (size_t i = 0; i < points_hand.size(); ++i) {
      const LabeledPoint& point = points_hand[i];
      const RecycledVector<Surface::Face>& faces = surface_.faces(point.label);
      closest_[i] = faces.empty() ? ClosestPoint{} : find(point, faces, warm_start(point, closest_[i], surface_));
      warm_start.found(point, closest_[i]);
    }
    return closest_;
  }

 private:
  void add_scene(const RecycledVector<Surface::Face>& faces) {
    const RTCScene scene = scenes_.emplace_back(rtcNewScene(device()));
    if (!faces.empty()) {
      const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(geometry, faces.size());
      rtcSetGeometryUserData(geometry, const_cast<Surface::Face*>(faces.data()));
      rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene);
  }

  ClosestPoint find(const LabeledPoint& point, const RecycledVector<Surface::Face>& faces,
                    const ClosestPoint& start) const {
    Nearest nearest{faces, start};
    const float radius = start.face < 0 ? std::numeric_limits<float>::infinity() : start.distance;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query{point.p.x(), point.p.y(), point.p.z(), 0, radius};
    rtcPointQuery(scenes_[point.label], &query, &context, consider, &nearest);
    return nearest.closest;
  }

  const Surface& surface_;
  std::vector<RTCScene> scenes_;  ///< one a label
  RecycledVector<ClosestPoint> closest_;
};

}  // namespace

const MakeClosestPointPeer kEmbree = make_search<EmbreeSearch>;

}  // namespace glovebench::bench
