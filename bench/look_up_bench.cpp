// The matching cascade, plain and fast, and its peers' brute force; each query is a frame's.

#include <fmt/format.h>

#include <chrono>
#include <map>

#include "bench/bench_data.h"
#include "bench/peers/peers.h"
#include "core/base/math.h"
#include "core/database/look_up.h"

namespace glovebench::bench {
namespace {

using Clock = std::chrono::steady_clock;

bool equal(const RecycledVector<Match>& a, const RecycledVector<Match>& b) {
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

/// The rows of the first stage that one query adds up, of all blocks: the least that a look-up over all entries
/// reads.
double row_bytes(const std::vector<TinyImages>& queries, const Cascade& cascade) {
  const FieldRows& rows = data().database->field_rows(cascade[0].size);
  size_t touched = 0;
  for (const TinyImages& query : queries) touched += rows.rows_of(query.images[0]).size();
  return static_cast<double>(touched * FieldRows::kBlock * rows.block_count()) /
         static_cast<double>(queries.size());
}

/// Returns the mistake in the matches, or null.
const char* mistake_in_look_up(const std::vector<TinyImages>& queries, const Cascade& cascade,
                               std::string_view implementation) {
  const Database& database = *data().database;
  for (const TinyImages& query : queries) {
    const RecycledVector<Match> matches = look_up(database, query, cascade, implementation);
    if (!equal(matches, look_up(database, query, cascade, "plain"))) return "the matches are not the plain ones";
    for (const Match& match : matches)
      if (match.error != distance(database, match.entry, query.images.back()))
        return "a match's error is not the distance of equation (2)";
  }
  return nullptr;
}

void run_look_up(benchmark::State& state, const char* text, std::string_view implementation) {
  const Database& database = *data().database;
  const Cascade cascade = parse_cascade(text);
  const std::vector<TinyImages> queries = queries_of(cascade);
  const char* mistake = once(fmt::format("{} {}", text, implementation),
                             [&] { return mistake_in_look_up(queries, cascade, implementation); });
  if (mistake != nullptr) return state.SkipWithError(mistake);
  std::vector<double> seconds;
  for (auto _ : state) {
    for (const TinyImages& query : queries) {
      const Clock::time_point start = Clock::now();
      benchmark::DoNotOptimize(look_up(database, query, cascade, implementation));
      seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  set_time_each(state, "frame", queries.size());
  state.counters["p50_us"] = 1e6 * *quantile_of(seconds, 0.5);
  state.counters["p99_us"] = 1e6 * *quantile_of(seconds, 0.99);
  state.counters["entries"] = database.entry_count();
  if (implementation == "fast" && cascade.size() == 1)
    set_bytes_touched(state, {.far = row_bytes(queries, cascade)});
  if (implementation == "plain") set_time_each(state, "read", static_cast<size_t>(plain_reads(queries, cascade)));
}

/// One query after the other, or all at once.
enum class Batch { single, all };

using AllMatches = std::vector<RecycledVector<Match>>;

/// A peer looks up all queries: nothing, or what is wrong with what it finds.
const char* find_mistake(const AllMatches& found, const std::vector<LabelImage>& queries, const Cascade& cascade) {
  for (size_t i = 0; i < queries.size(); ++i) {
    const RecycledVector<Match> expected = look_up(*data().database, {{queries[i]}}, cascade);
    // Of equally near entries it may take others.
    if (!std::ranges::equal(found[i], expected, {}, &Match::error, &Match::error))
      return "the matches are not the nearest";
    for (const Match& match : found[i])
      if (match.error != distance(*data().database, match.entry, queries[i]))
        return "a match's error is not the distance of equation (2)";
  }
  return nullptr;
}

/// A peer with its copy of the database, which may be four times as large. The copy is kept.
LookUpPeer& prepared(MakeLookUpPeer make, int size) {
  static std::map<std::pair<MakeLookUpPeer, int>, std::unique_ptr<LookUpPeer>> peers;
  std::unique_ptr<LookUpPeer>& peer = peers[{make, size}];
  if (peer == nullptr) peer = make(*data().database, size);
  return *peer;
}

/// With a cascade of one stage.
void run_look_up_peer(benchmark::State& state, const std::string& name, const char* text, MakeLookUpPeer make,
                      Batch batch) {
  if (make == nullptr) return state.SkipWithError(kMissing);
  const Cascade cascade = parse_cascade(text);
  const int keep = cascade[0].keep;
  LookUpPeer& peer = prepared(make, cascade[0].size);
  // Brute force takes as long for every query; alone, some of them say as much in less time.
  const size_t step = batch == Batch::all ? 1 : 4;
  std::vector<LabelImage> queries;
  for (size_t i = 0; i < data().frames.size(); i += step) {
    const BenchFrame& frame = data().frames[i];
    queries.push_back(make_tiny_image(frame.trace.cloud.labels, frame.square, cascade[0].size));
  }
  const auto find = [&] {
    if (batch == Batch::all) return peer(queries, keep);
    AllMatches found;
    for (const LabelImage& query : queries) found.push_back(peer({&query, 1}, keep)[0]);
    return found;
  };
  const char* mistake = once(name, [&] { return find_mistake(find(), queries, cascade); });
  if (mistake != nullptr) return state.SkipWithError(mistake);
  for (auto _ : state) benchmark::DoNotOptimize(find());
  set_time_each(state, "frame", queries.size());
  state.counters["entries"] = data().database->entry_count();
}

const int look_up_registered = [] {
  const auto name = [](const char* cascade, std::string_view engine) {
    return std::string("look_up/") + cascade + "/" + std::string(engine);
  };
  for (const char* cascade : {"16:500,64:3", "16:1000,32:300,64:3", "8:15", "16:3", "32:3", "exact:3"}) {
    for (const char* implementation : {"plain", "fast"}) {
      benchmark::RegisterBenchmark(name(cascade, implementation).c_str(), run_look_up, cascade, implementation)
          ->Unit(benchmark::kMillisecond);
    }
  }
  for (const char* cascade : {"16:3", "exact:3"}) {
    const auto add = [&](std::string_view engine, MakeLookUpPeer make, Batch batch) {
      const std::string full = name(cascade, engine);
      benchmark::RegisterBenchmark(full.c_str(), run_look_up_peer, full, cascade, make, batch)
          ->Unit(benchmark::kMillisecond);
    };
    add("faiss", kFaiss, Batch::single);
    add("faiss_batch", kFaiss, Batch::all);
    add("opencv", kOpenCv, Batch::single);
  }
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
