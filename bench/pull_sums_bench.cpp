// The sums of a Gauss-Newton step of the method `articulated`: one row for each point, and in vectors.

#include <algorithm>

#include "bench/bench_data.h"
#include "core/pose/pull_sums.h"
#include "core/pose/surface_matcher.h"

namespace glovebench::bench {
namespace {

constexpr PullWeights kWeights{.tukey_mm = 12, .tangential = 0.1};

/// A frame's points (8,000 at most) and what is nearest to them in the pose found.
struct Matched {
  SurfaceMatcher matcher;
  std::array<Screw, kAngleCount> screws;

  explicit Matched(const BenchFrame& frame)
      : matcher(*data().model, frame.posed, subsample(frame.trace.cloud.points, 8000), {}),
        screws(angle_screws(*data().model, frame.posed)) {
    matcher.cull(frame.result.T_camera_hand);
    matcher.match(frame.result.T_camera_hand);
  }
  MatchedPoints points() const { return {matcher.points_hand(), matcher.closest(), matcher.surface()}; }
};

NormalEquations plain_equations(const Matched& matched, std::span<const BodyShares> shares) {
  PlainPullSums sums(matched.screws);
  sums.add(matched.points(), data().model->triangles(), shares, kWeights);
  return sums.equations();
}

NormalEquations fast_equations(const Matched& matched, std::span<const FaceBodies> faces) {
  PullSums sums(matched.screws);
  sums.add(matched.points(), faces, kWeights);
  return sums.equations();
}

void pull_sums(benchmark::State& state, Implementation implementation) {
  const std::vector<BodyShares> shares = body_shares(*data().model);
  const std::vector<FaceBodies> faces = face_bodies(*data().model, shares);
  std::vector<std::unique_ptr<Matched>> frames;
  for (const BenchFrame* frame : some_frames()) frames.push_back(std::make_unique<Matched>(*frame));
  const bool are_equal = once("pull sums", [&] {
    return std::ranges::all_of(frames, [&](const auto& frame) {
      const NormalEquations plain = plain_equations(*frame, shares), fast = fast_equations(*frame, faces);
      return (plain.H - fast.H).cwiseAbs().maxCoeff() < 1e-6 * plain.H.cwiseAbs().maxCoeff();
    });
  });
  if (!are_equal) return state.SkipWithError("the sums differ from the plain ones");
  time_each(state, "frame", frames, [&](const std::unique_ptr<Matched>& frame) {
    return implementation == Implementation::plain ? plain_equations(*frame, shares)
                                                   : fast_equations(*frame, faces);
  });
}
BENCHMARK_CAPTURE(pull_sums, plain, Implementation::plain)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pull_sums, fast, Implementation::fast)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
