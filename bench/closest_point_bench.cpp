// The closest points of a frame's points while an alignment moves them: plain, fast, and the peers.

#include "bench/bench_data.h"
#include "bench/peers/peers.h"
#include "core/pose/closest_point.h"
#include "core/pose/closest_point_search.h"
#include "core/pose/icp.h"

namespace glovebench::bench {
namespace {

/// One frame's points in the hand frame as an alignment sees them: at the coarse pose, then nearer the final one.
struct PointSequence {
  Surface surface;
  std::vector<RecycledVector<LabeledPoint>> points_hand;
};

constexpr int kIterations = 10;

PointSequence make_sequence(const BenchFrame& frame, int max_points) {
  const Eigen::Isometry3d& coarse = frame.result.T_camera_hand_coarse;
  const Eigen::Isometry3d& fine = frame.result.T_camera_hand_unfiltered;
  const Eigen::Quaterniond q_coarse(coarse.linear()), q_fine(fine.linear());
  PointSequence sequence{Surface(*data().model, frame.posed, coarse.inverse().translation().cast<float>()), {}};
  const RecycledVector<LabeledPoint> cloud = subsample(frame.trace.cloud.points, max_points);
  for (int i = 0; i < kIterations; ++i) {
    const double share = 1 - std::pow(0.5, i);  // an alignment's steps shrink
    Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
    T_camera_hand.linear() = q_coarse.slerp(share, q_fine).toRotationMatrix();
    T_camera_hand.translation() = (1 - share) * coarse.translation() + share * fine.translation();
    RecycledVector<LabeledPoint> points = cloud;
    for (LabeledPoint& point : points) point.p = (T_camera_hand.inverse() * point.p.cast<double>()).cast<float>();
    sequence.points_hand.push_back(std::move(points));
  }
  return sequence;
}

/// Of every fourth frame: the plain search takes its time.
std::vector<PointSequence> make_sequences(int max_points) {
  std::vector<PointSequence> sequences;
  for (size_t i = 0; i < data().frames.size(); i += 4)
    sequences.push_back(make_sequence(data().frames[i], max_points));
  return sequences;
}

// One entry an engine: it takes a sequence and returns what it found at each pose, to be compared.
using Found = std::vector<RecycledVector<ClosestPoint>>;

Found find_plain(const PointSequence& sequence) {
  Found found;
  for (const auto& points : sequence.points_hand) found.push_back(closest_points_plain(points, sequence.surface));
  return found;
}

/// What the search makes of the surface is part of its time.
Found find_fast(const PointSequence& sequence) {
  ClosestPointSearch search(sequence.surface);
  Found found;
  for (const auto& points : sequence.points_hand) found.push_back(search(points));
  return found;
}

/// What the fast search does for each of its groups of points at each pose.
void set_work(benchmark::State& state, int max_points) {
  SearchWork work;
  for (const PointSequence& sequence : make_sequences(max_points)) {
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

Found find_peer(const PointSequence& sequence, MakeClosestPointPeer make) {
  const std::unique_ptr<ClosestPointPeer> search = make(sequence.surface);
  Found found;
  for (const auto& points : sequence.points_hand) found.push_back((*search)(points));
  return found;
}

bool equal(const ClosestPoint& a, const ClosestPoint& b) {
  return a.face == b.face && a.distance == b.distance && a.p_hand == b.p_hand;
}

/// A peer rounds otherwise, and may take another one of faces that are equally close.
bool nearly_equal(const ClosestPoint& a, const ClosestPoint& b) {
  constexpr float kRounding = 1e-6f;  // m: some roundings of a coordinate of up to 0.2 m
  return (a.face < 0) == (b.face < 0) && std::abs(a.distance - b.distance) <= kRounding;
}

/// What the fast search touches at least: at each pose of each point its share of its group, the point and the
/// answer. Faces serve many points.
double least_bytes(double points) {
  constexpr double kShareOfGroup = static_cast<double>(sizeof(PointGroup)) / PointGroup::kPoints;
  return kIterations * points * (kShareOfGroup + sizeof(LabeledPoint) + sizeof(ClosestPoint));
}

template <typename Find, typename Equal>
bool finds_what_plain_finds(const std::vector<PointSequence>& sequences, const Find& find, const Equal& is_equal) {
  return std::ranges::all_of(sequences, [&](const PointSequence& sequence) {
    return std::ranges::equal(find(sequence), find_plain(sequence), [&](const auto& found, const auto& expected) {
      return std::ranges::equal(found, expected, is_equal);
    });
  });
}

/// Returns the mean number of points.
template <typename Find, typename Equal>
double run(benchmark::State& state, const std::string& name, const Find& find, const Equal& is_equal,
           int max_points) {
  const std::vector<PointSequence> sequences = make_sequences(max_points);
  if (!once(name, [&] { return finds_what_plain_finds(sequences, find, is_equal); })) {
    state.SkipWithError("the search differs from the plain one");
    return 0;
  }
  double points = 0;
  for (const PointSequence& sequence : sequences)
    points += static_cast<double>(sequence.points_hand.front().size());
  for (auto _ : state) {
    for (const PointSequence& sequence : sequences) benchmark::DoNotOptimize(find(sequence));
  }
  points /= static_cast<double>(sequences.size());
  state.counters["points"] = points;
  set_time_each(state, "frame", sequences.size());
  return points;
}

void run_search_peer(benchmark::State& state, const std::string& name, MakeClosestPointPeer make, int max_points) {
  if (make == nullptr) return state.SkipWithError(kMissing);
  run(
      state, name, [make](const PointSequence& sequence) { return find_peer(sequence, make); }, nearly_equal,
      max_points);
}

void register_engines(const std::string& name, int max_points) {
  const auto add = [&](const std::string& engine, const auto& function) {
    const std::string full = name + "/" + engine;
    benchmark::RegisterBenchmark(full.c_str(), function, full)->Unit(benchmark::kMillisecond);
  };
  add("plain",
      [=](benchmark::State& state, const std::string& full) { run(state, full, find_plain, equal, max_points); });
  add("fast", [=](benchmark::State& state, const std::string& full) {
    set_bytes_touched(state, {.near = least_bytes(run(state, full, find_fast, equal, max_points))});
    set_work(state, max_points);
  });
  add("embree",
      [=](benchmark::State& state, const std::string& full) { run_search_peer(state, full, kEmbree, max_points); });
  add("cgal",
      [=](benchmark::State& state, const std::string& full) { run_search_peer(state, full, kCgal, max_points); });
}

// The paper profile's number of points, and about as many as the hand has at 0.7 m.
const int search_registered = [] {
  register_engines("closest_point", 1000);
  register_engines("closest_point_3000", 3000);
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
