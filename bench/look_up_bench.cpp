#include "bench/bench_data.h"
#include "core/database/look_up.h"

namespace glovebench::bench {
namespace {

/// A match's error is the distance of equation (2), and no entry outside the matches is nearer.
bool is_exhaustive_answer(const Database& database, const LabelImage& query, const std::vector<Match>& matches) {
  for (const Match& match : matches) {
    if (match.error != distance(database, match.entry, query)) return false;
  }
  for (int entry = 0; entry < database.entry_count(); ++entry) {
    const bool is_match =
        std::any_of(matches.begin(), matches.end(), [&](const Match& match) { return match.entry == entry; });
    if (!is_match && distance(database, entry, query) < matches.back().error) return false;
  }
  return true;
}

void run_look_up(benchmark::State& state, const Cascade& cascade, bool exhaustive) {
  const Database& database = *data().database;
  std::vector<TinyImages> queries;
  for (const BenchFrame& frame : data().frames) {
    queries.push_back(make_tiny_images(frame.trace.cloud.labels, frame.square, cascade));
    const std::vector<Match> matches = look_up(database, queries.back(), cascade);
    for (const Match& match : matches) {
      if (match.error != distance(database, match.entry, queries.back().images.back())) {
        return state.SkipWithError("a match's error is not the distance of equation (2)");
      }
    }
    if (exhaustive && !is_exhaustive_answer(database, queries.back().images.back(), matches)) {
      return state.SkipWithError("the look-up missed a nearer entry");
    }
  }
  for (auto _ : state) {
    for (const TinyImages& query : queries) benchmark::DoNotOptimize(look_up(database, query, cascade));
  }
  set_time_each(state, "frame", queries.size());
  state.counters["entries"] = database.entry_count();
}

void cascade_look_up(benchmark::State& state) {
  run_look_up(state, data().config.lookup.cascade, false);
}
BENCHMARK(cascade_look_up)->Name("look_up/cascade")->Unit(benchmark::kMillisecond);

void exhaustive_look_up(benchmark::State& state) {
  run_look_up(state, {{64, 3}}, true);
}
BENCHMARK(exhaustive_look_up)->Name("look_up/exhaustive")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
