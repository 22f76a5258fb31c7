#include "reports/comparison/worst_frames.h"

#include <algorithm>
#include <cstdlib>

namespace glovebench::reports {
namespace {

constexpr double kLost_mm = 50;
constexpr double kUnchanged_mm = 0.01;
constexpr int kDistinctFrames = 8;

double change_of(const ChangedFrame& frame) {
  return frame.candidate_vertex_error_mm.value_or(kLost_mm) - frame.baseline_vertex_error_mm.value_or(kLost_mm);
}

std::vector<ChangedFrame> frames_that_got_worse(const Pairing& pairing) {
  std::vector<ChangedFrame> frames;
  for (const auto& [baseline, candidate] : pairing.experiments) {
    for (size_t s = 0; s < baseline->runs.size(); ++s) {
      const SeedRun &before = baseline->runs[s], &after = candidate->runs[s];
      for (size_t f = 0; f < before.frames.size(); ++f) {
        const ChangedFrame frame = {baseline->key,
                                    before.seed,
                                    after.seed,
                                    before.frames[f].frame,
                                    before.frames[f]["vertex_error_mm"],
                                    after.frames[f]["vertex_error_mm"]};
        if (change_of(frame) > kUnchanged_mm) frames.push_back(frame);
      }
    }
  }
  return frames;
}

}  // namespace

std::vector<ChangedFrame> worst_frames(const Pairing& pairing) {
  if (std::ranges::find(pairing.metrics, "vertex_error_mm", &Metric::key) == pairing.metrics.end()) return {};
  std::vector<ChangedFrame> frames = frames_that_got_worse(pairing);
  std::ranges::stable_sort(frames, std::greater(), change_of);
  std::vector<ChangedFrame> worst;
  for (const ChangedFrame& frame : frames) {
    if (worst.size() == kWorstFrames) break;
    const bool shown = std::ranges::any_of(worst, [&](const ChangedFrame& other) {
      return other.key == frame.key && std::abs(other.frame - frame.frame) <= kDistinctFrames;
    });
    if (!shown) worst.push_back(frame);
  }
  return worst;
}

}  // namespace glovebench::reports
