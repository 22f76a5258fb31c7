#include "eval/replay_all.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "eval/stored_replay.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

std::optional<TrackedReplays> load(const RunFolder& run_folder, const std::string& key) {
  const std::optional<std::string> stored = run_folder.load(key);
  return stored ? replay_from_bytes(*stored) : std::nullopt;
}

/// Replays that share their images, or what an interrupted run stored of them.
std::vector<TrackedReplays> replay_group(Workbench& workbench, std::span<const Replay> group,
                                         const RunFolder* run_folder, const std::function<void()>& frame_done) {
  std::vector<TrackedReplays> outputs(group.size());
  std::vector<Replay> left;
  std::vector<size_t> places;
  for (size_t i = 0; i < group.size(); ++i) {
    if (run_folder) {
      if (auto stored = load(*run_folder, replay_key(workbench, group[i]))) {
        outputs[i] = *std::move(stored);
        for (size_t f = 0; f < frames_of(group[i]).size(); ++f) frame_done();
        continue;
      }
    }
    left.push_back(group[i]);
    places.push_back(i);
  }
  if (left.empty()) return outputs;
  std::vector<TrackedReplays> made = replay_together(workbench, left, frame_done);
  for (size_t i = 0; i < left.size(); ++i) {
    if (run_folder) run_folder->store(replay_key(workbench, left[i]), to_bytes(made[i]));
    outputs[places[i]] = std::move(made[i]);
  }
  return outputs;
}

/// Where each group of replays that are rendered once begins, and the end. Larger groups save rendering, but there
/// must be enough of them for all threads.
std::vector<size_t> group_begins(std::span<const Replay> replays, int threads) {
  constexpr size_t kLargest = 8;  // each replay of a group has trackers of its own in memory
  const size_t size = std::clamp<size_t>(replays.size() / (2 * static_cast<size_t>(threads)), 1, kLargest);
  std::vector<size_t> begins;
  for (size_t r = 0; r < replays.size(); ++r) {
    const bool joins =
        !begins.empty() && r - begins.back() < size && share_images(replays[begins.back()], replays[r]);
    if (!joins) begins.push_back(r);
  }
  begins.push_back(replays.size());
  return begins;
}

}  // namespace

void prepare(Workbench& workbench, std::span<const Replay> replays) {
  for (const Replay& replay : replays) {
    frames_of(replay);
    workbench.subject(replay.subject);
    // Before the threads start: building a database uses all of them itself.
    for (const std::string& name : replay.databases) workbench.database(name);
  }
  for (const Replay& replay : replays) workbench.color_table(replay.tracker.segmentation.color_space);
}

std::vector<TrackedReplays> replay_all(Workbench& workbench, std::span<const Replay> replays, int threads,
                                       const RunFolder* run_folder) {
  size_t frames = 0;
  for (const Replay& replay : replays) frames += frames_of(replay).size();
  std::vector<TrackedReplays> outputs(replays.size());
  const std::vector<size_t> begins = group_begins(replays, threads);
  Progress progress("replaying", workbench.config().quiet);
  std::atomic<size_t> done{0};
  const auto frame_done = [&] { progress.show(static_cast<double>(++done) / static_cast<double>(frames)); };
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, begins.size() - 1, 1),
        [&](const tbb::blocked_range<size_t>& range) {
          for (size_t g = range.begin(); g != range.end(); ++g) {
            const std::span<const Replay> group = replays.subspan(begins[g], begins[g + 1] - begins[g]);
            std::ranges::move(replay_group(workbench, group, run_folder, frame_done),
                              outputs.begin() + static_cast<std::ptrdiff_t>(begins[g]));
          }
        },
        tbb::simple_partitioner());
  });
  return outputs;
}

}  // namespace glovebench::eval
