// The matching cascade, plain and fast, and its peers' brute force; each query is a frame's.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>

#include "bench/bench_data.h"
#include "bench/peers/peers.h"
#include "core/base/math.h"
#include "core/database/look_up.h"
#include "core/database/look_up_parts.h"

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

/// The rows of the first stage that one query adds up, of all blocks: the least bytes that a look-up over all
/// entries reads.
double row_bytes(const std::vector<TinyImages>& queries, const Cascade& cascade) {
  const FieldRows& rows = data().database->field_rows(cascade[0].size);
  size_t touched = 0;
  for (const TinyImages& query : queries) touched += rows.rows_of(query.images[0]).size();
  return static_cast<double>(touched * FieldRows::kBlock * rows.block_count()) /
         static_cast<double>(queries.size());
}

/// Numbers that the fast look-up adds up at least for one query, by a cascade of one stage: rows, and the fields of
/// each entry whose bound is not above the distance of the last match.
double fast_work(const std::vector<TinyImages>& queries, const Cascade& cascade) {
  const Database& database = *data().database;
  const FieldRows& rows = database.field_rows(cascade[0].size);
  if (rows.exact()) return row_bytes(queries, cascade);
  double fields = 0;
  for (const TinyImages& query : queries) {
    const auto glove = static_cast<double>(glove_offsets(query.images[0]).size());
    const auto query_rows = rows.rows_of(query.images[0]);
    const double limit = std::round(look_up(database, query, cascade).back().error * kFieldScale * glove);
    for (int entry = 0; entry < database.entry_count(); ++entry)
      if (rows.sum(entry, query_rows) <= limit) fields += glove;
  }
  return row_bytes(queries, cascade) + fields / static_cast<double>(queries.size());
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
  if (implementation == "fast" && cascade.size() == 1) {
    set_bytes_touched(state, {.far = row_bytes(queries, cascade)});
    state.counters["work"] = once(text, [&] { return fast_work(queries, cascade); });
  }
  if (implementation == "plain") {
    const double reads = plain_reads(queries, cascade);
    state.counters["work"] = reads / static_cast<double>(queries.size());
    set_time_each(state, "read", static_cast<size_t>(reads));
  }
}

enum class Batch { single, all };
enum class Finds { nearest, near };

struct LookUpEngine {
  std::string_view name;
  MakeLookUpPeer make;
  Finds finds = Finds::nearest;
  Batch batch = Batch::single;
};

using AllMatches = std::vector<RecycledVector<Match>>;

/// Of what a peer finds for all queries. Of equally near entries it may take others.
struct Recall {
  double first = 0;  ///< share of queries whose first entry is a nearest one
  double all = 0;    ///< share of the `keep` nearest
  bool errors_are_distances = true;
};

Recall recall_of(const AllMatches& found, const std::vector<LabelImage>& queries, const Cascade& cascade) {
  Recall recall;
  for (size_t i = 0; i < queries.size(); ++i) {
    const RecycledVector<Match> nearest = look_up(*data().database, {{queries[i]}}, cascade);
    const auto share = 1.0 / static_cast<double>(queries.size() * nearest.size());
    for (const Match& match : found[i]) {
      const float error = match.entry < 0 ? INFINITY : distance(*data().database, match.entry, queries[i]);
      recall.errors_are_distances &= match.error == error;
      if (error <= nearest.back().error) recall.all += share;
      if (&match == &found[i].front() && error == nearest.front().error)
        recall.first += share * static_cast<double>(nearest.size());
    }
  }
  return recall;
}

struct Prepared {
  std::unique_ptr<LookUpPeer> peer;
  double build_s = 0;
};

/// A peer with its copy of the database, which may be four times as large. The copy is kept.
const Prepared& prepared(MakeLookUpPeer make, int size) {
  static std::map<std::pair<MakeLookUpPeer, int>, Prepared> peers;
  Prepared& result = peers[{make, size}];
  if (result.peer == nullptr) {
    const Clock::time_point start = Clock::now();
    result.peer = make(*data().database, size);
    result.build_s = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return result;
}

/// Brute force takes as long for every query; alone, some of them say as much in less time.
std::vector<LabelImage> peer_queries(int size, Batch batch) {
  const size_t step = batch == Batch::all ? 1 : 4;
  std::vector<LabelImage> queries;
  for (size_t i = 0; i < data().frames.size(); i += step) {
    const BenchFrame& frame = data().frames[i];
    queries.push_back(make_tiny_image(frame.trace.cloud.labels, frame.square, size));
  }
  return queries;
}

/// With a cascade of one stage.
void run_look_up_peer(benchmark::State& state, const char* text, const LookUpEngine& engine) {
  if (engine.make == nullptr) return state.SkipWithError(kMissing);
  const Cascade cascade = parse_cascade(text);
  const Prepared& ready = prepared(engine.make, cascade[0].size);
  const std::vector<LabelImage> queries = peer_queries(cascade[0].size, engine.batch);
  const auto find = [&] {
    if (engine.batch == Batch::all) return ready.peer->look_up_all(queries, cascade[0].keep);
    AllMatches found;
    for (const LabelImage& query : queries) found.push_back(ready.peer->look_up(query, cascade[0].keep));
    return found;
  };
  const Recall recall =
      once(fmt::format("{} {}", text, engine.name), [&] { return recall_of(find(), queries, cascade); });
  if (engine.finds == Finds::nearest && recall.all < 1 - 1e-9)
    return state.SkipWithError("the matches are not the nearest");
  if (engine.finds == Finds::nearest && !recall.errors_are_distances)
    return state.SkipWithError("a match's error is not the distance of equation (2)");
  for (auto _ : state) benchmark::DoNotOptimize(find());
  set_time_each(state, "frame", queries.size());
  state.counters["entries"] = data().database->entry_count();
  state.counters["work"] = ready.peer->work();
  state.counters["build_s"] = ready.build_s;
  state.counters["recall_1"] = recall.first;
  state.counters[fmt::format("recall_{}", cascade[0].keep)] = recall.all;
}

// What finds near entries solves another problem: its name keeps it out of the ratios.
const int look_up_registered = [] {
  for (const char* cascade : {"16:500,64:3", "16:1000,32:300,64:3", "8:15", "16:3", "32:3", "exact:3"})
    for (const char* implementation : {"plain", "fast"})
      benchmark::RegisterBenchmark(fmt::format("look_up/{}/{}", cascade, implementation).c_str(), run_look_up,
                                   cascade, implementation)
          ->Unit(benchmark::kMillisecond);
  const std::vector<LookUpEngine> engines = {{"faiss", kFaiss},
                                             {"faiss_batch", kFaiss, Finds::nearest, Batch::all},
                                             {"faiss_bytes", kFaissBytes},
                                             {"opencv", kOpenCv},
                                             {"sparse", kSparse},
                                             {"sparse_rows", kSparseRows},
                                             {"faiss_8bit", kFaiss8Bit, Finds::near},
                                             {"faiss_pq", kFaissPq, Finds::near},
                                             {"faiss_hnsw", kFaissHnsw, Finds::near}};
  for (const char* cascade : {"16:3", "exact:3"}) {
    for (const LookUpEngine& engine : engines) {
      if (engine.name == "faiss_hnsw" && std::string_view(cascade) == "exact:3")
        continue;  // many minutes for its graph
      const char* const part = engine.finds == Finds::near ? "near/" : "";
      benchmark::RegisterBenchmark(fmt::format("look_up/{}/{}{}", cascade, part, engine.name).c_str(),
                                   run_look_up_peer, cascade, engine)
          ->Unit(benchmark::kMillisecond);
    }
  }
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
