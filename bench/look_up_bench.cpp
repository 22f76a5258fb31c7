// The matching cascade, plain and fast; each query is a frame's.

#include "core/database/look_up.h"

#include <chrono>

#include "bench/bench_data.h"

namespace glovebench::bench {
namespace {

using Clock = std::chrono::steady_clock;

bool equal(const std::vector<Match>& a, const std::vector<Match>& b) {
  return std::ranges::equal(
      a, b, [](const Match& x, const Match& y) { return x.entry == y.entry && x.error == y.error; });
}

std::vector<TinyImages> queries_of(const Cascade& cascade) {
  std::vector<TinyImages> queries;
  for (const BenchFrame& frame : data().frames)
    queries.push_back(make_tiny_images(frame.trace.cloud.labels, frame.square, cascade));
  return queries;
}

/// Glove pixels of all queries in all stages, times the entries that a plain look-up reads them from.
double plain_reads(const std::vector<TinyImages>& queries, const Cascade& cascade) {
  double reads = 0;
  for (const TinyImages& query : queries) {
    double entries = data().database->entry_count();
    for (size_t s = 0; s < cascade.size(); ++s) {
      const LabelImage& image = query.images[s];
      reads += entries * static_cast<double>(image.size() - std::ranges::count(image, 0));
      entries = std::min<double>(entries, cascade[s].keep);
    }
  }
  return reads;
}

/// What a share of the values lies below, us.
double quantile_us(std::vector<double>& seconds, double share) {
  const auto nth = seconds.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(seconds.size() - 1));
  std::nth_element(seconds.begin(), nth, seconds.end());
  return 1e6 * *nth;
}

void run_look_up(benchmark::State& state, const char* text, Implementation implementation) {
  const Database& database = *data().database;
  const Cascade cascade = parse_cascade(text);
  const std::vector<TinyImages> queries = queries_of(cascade);
  for (const TinyImages& query : queries) {
    const std::vector<Match> matches = look_up(database, query, cascade, implementation);
    if (!equal(matches, look_up(database, query, cascade, Implementation::plain)))
      return state.SkipWithError("the matches are not the plain ones");
    for (const Match& match : matches)
      if (match.error != distance(database, match.entry, query.images.back()))
        return state.SkipWithError("a match's error is not the distance of equation (2)");
  }
  std::vector<double> seconds;
  for (auto _ : state) {
    for (const TinyImages& query : queries) {
      const Clock::time_point start = Clock::now();
      benchmark::DoNotOptimize(look_up(database, query, cascade, implementation));
      seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  set_time_each(state, "frame", queries.size());
  state.counters["p50_us"] = quantile_us(seconds, 0.5);
  state.counters["p99_us"] = quantile_us(seconds, 0.99);
  state.counters["entries"] = database.entry_count();
  if (implementation == Implementation::plain)
    set_time_each(state, "read", static_cast<size_t>(plain_reads(queries, cascade)));
}

const int registered = [] {
  for (const char* cascade : {"16:500,64:3", "16:1000,32:300,64:3", "8:15", "16:3", "32:3", "exact:3"}) {
    for (const Implementation implementation : {Implementation::plain, Implementation::fast}) {
      const std::string name = std::string("look_up/") + cascade + "/" + std::string(to_string(implementation));
      benchmark::RegisterBenchmark(name.c_str(), run_look_up, cascade, implementation)
          ->Unit(benchmark::kMillisecond);
    }
  }
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
