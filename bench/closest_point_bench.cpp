// The closest points of a frame's points while an alignment moves them: plain, fast, and the peers.

#include <fmt/format.h>

#include <utility>

#include "bench/bench_data.h"
#include "bench/peers/peers.h"
#include "core/pose/alignment.h"
#include "core/pose/closest_point.h"
#include "core/pose/closest_point_search.h"
#include "core/pose/surface_matcher.h"

namespace glovebench::bench {
namespace {

/// One frame's points in the hand frame, wherever its alignment by Horn's method searches.
struct PointSequence {
  Surface surface;
  std::vector<RecycledVector<LabeledPoint>> points_hand;
};

/// The coarse pose and the one after each iteration.
std::vector<Eigen::Isometry3d> searched_poses(const BenchFrame& frame, int max_points) {
  IcpConfig config = data().config.icp;
  config.algorithm = "horn";
  config.max_points = max_points;
  std::vector<Eigen::Isometry3d> poses = {frame.result.T_camera_hand_coarse};
  const int most = std::exchange(config.max_iterations, 0);
  bool is_done = false;
  while (!is_done) {
    ++config.max_iterations;
    const Alignment alignment = align(*data().model, frame.posed, frame.trace.cloud.points, poses.front(), config);
    poses.push_back(alignment.T_camera_hand);
    is_done = alignment.status != AlignmentStatus::not_converged || config.max_iterations == most;
  }
  return poses;
}

PointSequence make_sequence(const BenchFrame& frame, int max_points) {
  PointSequence sequence{Surface(*data().model, frame.posed, viewpoint_hand(frame.result.T_camera_hand_coarse)),
                         {}};
  const RecycledVector<LabeledPoint> cloud = subsample(frame.trace.cloud.points, max_points);
  for (const Eigen::Isometry3d& T_camera_hand : searched_poses(frame, max_points)) {
    RecycledVector<LabeledPoint> points = cloud;
    for (LabeledPoint& point : points) point.p = (T_camera_hand.inverse() * point.p.cast<double>()).cast<float>();
    sequence.points_hand.push_back(std::move(points));
  }
  return sequence;
}

/// Of every fourth frame: the plain search takes its time.
std::vector<PointSequence> make_sequences(int max_points) {
  return once(fmt::format("sequences of {} points", max_points), [&] {
    std::vector<PointSequence> sequences;
    for (size_t i = 0; i < data().frames.size(); i += 4)
      sequences.push_back(make_sequence(data().frames[i], max_points));
    return sequences;
  });
}

// Our own searches in the place of a peer.
class PlainSearch : public ClosestPointPeer {
 public:
  explicit PlainSearch(const Surface& surface) : surface_(surface) {}
  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) override {
    return closest_ = closest_points_plain(points_hand, surface_);
  }

 private:
  const Surface& surface_;
  RecycledVector<ClosestPoint> closest_;
};

class FastSearch : public ClosestPointPeer {
 public:
  explicit FastSearch(const Surface& surface) : search_(surface) {}
  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) override {
    return search_(points_hand);
  }

 private:
  ClosestPointSearch search_;
};

/// Counts the work of a group of points, on average over its searches.
void set_work(benchmark::State& state, const std::vector<PointSequence>& sequences) {
  SearchWork work;
  for (const PointSequence& sequence : sequences) {
    ClosestPointSearch search(sequence.surface);
    for (const auto& points : sequence.points_hand) search(points);
    work.groups += search.work().groups;
    work.nearest += search.work().nearest;
    work.measured += search.work().measured;
    work.boxes += search.work().boxes;
  }
  const auto groups = static_cast<double>(work.groups);
  state.counters["groups"] = groups;
  state.counters["nearest"] = static_cast<double>(work.nearest) / groups;
  state.counters["measured"] = static_cast<double>(work.measured) / groups;
  state.counters["boxes"] = static_cast<double>(work.boxes) / groups;
}

bool equal(const ClosestPoint& a, const ClosestPoint& b) {
  return a.face == b.face && a.distance == b.distance && a.p_hand == b.p_hand;
}

/// A peer rounds otherwise, and may take another one of faces that are equally close.
bool nearly_equal(const ClosestPoint& a, const ClosestPoint& b) {
  constexpr float kRounding = 1e-6f;  // m: some roundings of a coordinate of up to 0.2 m
  return (a.face < 0) == (b.face < 0) && std::abs(a.distance - b.distance) <= kRounding;
}

/// Compares with the plain search at each pose.
bool finds_what_plain_finds(const std::vector<PointSequence>& sequences, MakeClosestPointPeer make,
                            bool (*is_equal)(const ClosestPoint&, const ClosestPoint&)) {
  if (make == make_search<PlainSearch>) return true;
  return std::ranges::all_of(sequences, [&](const PointSequence& sequence) {
    const std::unique_ptr<ClosestPointPeer> search = make(sequence.surface);
    return std::ranges::all_of(sequence.points_hand, [&](const RecycledVector<LabeledPoint>& points) {
      return std::ranges::equal((*search)(points), closest_points_plain(points, sequence.surface), is_equal);
    });
  });
}

struct Engine {
  const char* name;
  MakeClosestPointPeer make;
  bool (*is_equal)(const ClosestPoint&, const ClosestPoint&) = nearly_equal;
};

/// What an engine makes of a frame's surface.
void run_build(benchmark::State& state, const Engine& engine, int max_points) {
  if (engine.make == nullptr) return state.SkipWithError(kMissing);
  const std::vector<PointSequence> sequences = make_sequences(max_points);
  time_each(state, "frame", sequences,
            [&](const PointSequence& sequence) { return engine.make(sequence.surface); });
}

/// All searches of an alignment, in a new structure.
void run_query(benchmark::State& state, const Engine& engine, int max_points) {
  if (engine.make == nullptr) return state.SkipWithError(kMissing);
  const std::vector<PointSequence> sequences = make_sequences(max_points);
  if (!once(fmt::format("{} {}", engine.name, max_points),
            [&] { return finds_what_plain_finds(sequences, engine.make, engine.is_equal); }))
    return state.SkipWithError("the search differs from the plain one");
  std::vector<std::unique_ptr<ClosestPointPeer>> searches;
  for (auto _ : state) {
    state.PauseTiming();
    searches.clear();
    for (const PointSequence& sequence : sequences) searches.push_back(engine.make(sequence.surface));
    state.ResumeTiming();
    for (size_t i = 0; i < sequences.size(); ++i)
      for (const auto& points : sequences[i].points_hand) benchmark::DoNotOptimize((*searches[i])(points).data());
  }
  set_time_each(state, "frame", sequences.size());
  double poses = 0, points = 0;
  for (const PointSequence& sequence : sequences) {
    poses += static_cast<double>(sequence.points_hand.size());
    points += static_cast<double>(sequence.points_hand.size() * sequence.points_hand.front().size());
  }
  state.counters["poses"] = poses / static_cast<double>(sequences.size());
  state.counters["points"] = points / poses;
  if (engine.make != make_search<FastSearch>) return;
  // What the fast search touches at least: at each pose of each point its share of its group, the point and the
  // answer. Faces serve many points.
  constexpr double kBytes =
      static_cast<double>(sizeof(PointGroup)) / PointGroup::kPoints + sizeof(LabeledPoint) + sizeof(ClosestPoint);
  set_bytes_touched(state, {.near = kBytes * points / static_cast<double>(sequences.size())});
  set_work(state, sequences);
}

void register_engines(const std::string& name, int max_points) {
  const auto add = [&](const std::string& part, const Engine& engine, const auto& run) {
    benchmark::RegisterBenchmark((name + part + engine.name).c_str(), run, engine, max_points)
        ->Unit(benchmark::kMillisecond);
  };
  add("/query/", {"plain", make_search<PlainSearch>, equal}, run_query);
  for (const Engine& engine :
       {Engine{"fast", make_search<FastSearch>, equal}, Engine{"embree", kEmbree}, Engine{"cgal", kCgal}}) {
    add("/build/", engine, run_build);
    add("/query/", engine, run_query);
  }
}

// The paper profile's number of points, and about as many as the hand has at 0.7 m.
const int search_registered = [] {
  register_engines("closest_point", 1000);
  register_engines("closest_point_3000", 3000);
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
