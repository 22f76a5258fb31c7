// glovebench_scale: what databases of many postures cost. For each number of postures, one after the other: builds
// a database of random postures with images of 64 px, loads it with nothing of it in memory and again with all that
// fits, and looks up frames in it. bench/README.md, "Scale".

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include <fmt/format.h>

#include "bench/bench_data.h"
#include "bench/scale/process_memory.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "render/label_renderer.h"

namespace glovebench::bench {
namespace {

using nlohmann::ordered_json;

constexpr std::array kSizes = {64};
constexpr int kRepetitions = 3;              ///< of the queries with all in memory
constexpr int kMostEntriesChecked = 80'000;  ///< of a database whose matches are compared with the plain ones

struct Options {
  std::vector<int> postures;
  bool normal_memory = false, keep = false;
  std::string folder, cache, output;
  std::string cascade = "exact:3";
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

/// Of this thread, ms.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// `count` postures with a straight wrist. Each angle is drawn evenly from within its limits. A larger count only
/// appends.
PostureSet random_postures(int count) {
  PostureSet set{fmt::format("DB_{}_random", count), {}, {}};
  for (int p = 0; p < count; ++p) {
    RandomStream random(1, "scale", p, "posture");
    Posture posture = Posture::Zero();
    for (int angle = kThumbCmcAbduction; angle < kAngleCount; ++angle) {
      const AngleInfo& info = angle_infos()[angle];
      posture[angle] = radians_from_degrees(random.uniform(info.min_deg, info.max_deg));
    }
    set.posture_names.push_back(fmt::format("random_{:05}", p + 1));
    set.postures.push_back(posture);
  }
  return set;
}

ordered_json build(const std::string& path, int count, const Options& options, DatabaseMemory memory) {
  reset_peak();
  const int64_t before = resident_memory().anonymous;
  int64_t peak_anonymous = 0;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  int percent = -1;
  const auto progress = [&](double share) {
    if (static_cast<int>(100 * share) == percent) return;
    percent = static_cast<int>(100 * share);
    peak_anonymous = std::max(peak_anonymous, resident_memory().anonymous - before);
    if (percent % 10 == 0)
      fmt::print(stderr, "glovebench_scale: {} postures: {}% in {:.0f} s\n", count, percent, seconds_since(start));
  };
  Database::build_file(path, random_postures(count), *data().model, data().config.views,
                       render::label_renderer_factory(), options.threads, progress, kSizes, memory);
  return {{"seconds", seconds_since(start)},
          {"processor_seconds", static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC},
          {"peak_anonymous_bytes", peak_anonymous},
          {"peak_resident_bytes", resident_memory().peak}};
}

/// Loads the database, and says how long that took and what it left in memory.
std::pair<Database, ordered_json> load(const std::string& path) {
  reset_peak();
  const ResidentMemory before = resident_memory();
  const PageFaults faults = page_faults();
  const auto start = std::chrono::steady_clock::now();
  Database database = Database::load(path, kSizes);
  const double seconds = seconds_since(start);
  const ResidentMemory after = resident_memory();
  ordered_json measured = {{"seconds", seconds},
                           {"anonymous_bytes", after.anonymous - before.anonymous},
                           {"file_bytes", after.file - before.file},
                           {"peak_resident_bytes", after.peak},
                           {"major_faults", page_faults().major - faults.major},
                           {"minor_faults", page_faults().minor - faults.minor}};
  return {std::move(database), std::move(measured)};
}

/// Looks up each frame. `before` is called before each, outside of the time.
ordered_json look_up_all(const Database& database, const Cascade& cascade, int repetitions,
                         const std::function<void()>& before) {
  std::vector<double> ms, processor;
  double major = 0, minor = 0;
  for (int r = 0; r < repetitions; ++r) {
    for (const BenchFrame& frame : data().frames) {
      const TinyImages query = make_tiny_images(frame.trace.cloud.labels, frame.square, cascade);
      before();
      const PageFaults faults = page_faults();
      const auto start = std::chrono::steady_clock::now();
      const double processor_start = processor_ms();
      const RecycledVector<Match> matches = look_up(database, query, cascade);
      processor.push_back(processor_ms() - processor_start);
      ms.push_back(1000 * seconds_since(start));
      if (matches.empty()) throw Error("look-up", "matches", "none", "the nearest entries");
      major += static_cast<double>(page_faults().major - faults.major);
      minor += static_cast<double>(page_faults().minor - faults.minor);
    }
  }
  const auto count = static_cast<double>(ms.size());
  return {{"p50_ms", *quantile_of(ms, 0.5)},
          {"p99_ms", *quantile_of(ms, 0.99)},
          {"p50_processor_ms", *quantile_of(processor, 0.5)},
          {"p99_processor_ms", *quantile_of(processor, 0.99)},
          {"major_faults", major / count},
          {"minor_faults", minor / count}};
}

/// Throws Error if the fast look-up does not find what the plain one finds.
void check_matches(const Database& database, const Cascade& cascade) {
  for (const size_t f : {size_t{0}, data().frames.size() / 2}) {
    const BenchFrame& frame = data().frames[f];
    const TinyImages query = make_tiny_images(frame.trace.cloud.labels, frame.square, cascade);
    const auto equal = [](const Match& a, const Match& b) { return a.entry == b.entry && a.error == b.error; };
    if (!std::ranges::equal(look_up(database, query, cascade), look_up(database, query, cascade, "plain"), equal))
      throw Error("look-up", "matches", "others", "those of the plain look-up");
  }
}

/// Loads a database and looks up frames in it, first with nothing of it in memory.
ordered_json use(const std::string& path, const Options& options) {
  ordered_json result;
  drop_from_memory(path);
  result["load_cold"] = load(path).second;
  auto [database, loaded] = load(path);
  const auto bytes = std::filesystem::file_size(path);
  result["entries"] = database.entry_count();
  result["file_bytes"] = bytes;
  result["entry_bytes"] = static_cast<double>(bytes) / database.entry_count();
  result["load_warm"] = loaded;
  const Cascade cascade = parse_cascade(options.cascade);
  result["query_cold"] = look_up_all(database, cascade, 1, [&] { drop_from_memory(path); });
  look_up_all(database, cascade, 1, [] {});
  result["query_warm"] = look_up_all(database, cascade, kRepetitions, [] {});
  const ResidentMemory resident = resident_memory();
  result["resident_anonymous_bytes"] = resident.anonymous;
  result["resident_file_bytes"] = resident.file;
  if (database.entry_count() <= kMostEntriesChecked) check_matches(database, cascade);
  return result;
}

/// One database.
ordered_json measure(int count, const Options& options) {
  const DatabaseMemory memory = options.normal_memory ? DatabaseMemory::normal : DatabaseMemory::low;
  const std::string path = fmt::format("{}/scale-{}-{}.glovedb", options.folder, count, to_string(memory));
  ordered_json result = {
      {"postures", count},
      {"memory", to_string(memory)},
      {"cascade", options.cascade},
      {"build", std::filesystem::exists(path) ? ordered_json() : build(path, count, options, memory)}};
  result.update(use(path, options));
  if (!options.keep) std::filesystem::remove(path);
  return result;
}

/// A row of the table, and what each column is headed.
std::vector<std::pair<const char*, std::string>> row_of(const ordered_json& r) {
  const auto text = [&](const char* part, const char* key, double unit, int digits) {
    return r[part].is_null() ? "-" : fmt::format("{:.{}f}", r[part][key].get<double>() / unit, digits);
  };
  const auto query = [&](const char* part, const std::string& clock) {
    return text(part, ("p50" + clock + "_ms").c_str(), 1, 2) + " / " +
           text(part, ("p99" + clock + "_ms").c_str(), 1, 2);
  };
  return {{"postures", r["postures"].dump()},
          {"million entries", fmt::format("{:.3f}", r["entries"].get<double>() / 1e6)},
          {"memory", r["memory"]},
          {"bytes an entry", fmt::format("{:.0f}", r["entry_bytes"].get<double>())},
          {"file GB", fmt::format("{:.2f}", r["file_bytes"].get<double>() / 1e9)},
          {"build s", text("build", "seconds", 1, 0)},
          {"processor s", text("build", "processor_seconds", 1, 0)},
          {"memory to build MB", text("build", "peak_anonymous_bytes", 1e6, 0)},
          {"load s, cold", text("load_cold", "seconds", 1, 2)},
          {"load s, warm", text("load_warm", "seconds", 1, 2)},
          {"resident GB", text("load_warm", "anonymous_bytes", 1e9, 2)},
          {"query ms, cold: p50 / p99", query("query_cold", "")},
          {"major faults", text("query_cold", "major_faults", 1, 0)},
          {"warm: p50 / p99", query("query_warm", "")},
          {"warm, processor: p50 / p99", query("query_warm", "_processor")},
          {"major, minor faults",
           text("query_warm", "major_faults", 1, 1) + ", " + text("query_warm", "minor_faults", 1, 1)}};
}

/// In Markdown.
std::string table_of(const ordered_json& results) {
  std::string headings = "|", line = "|", rows;
  for (const ordered_json& result : results) {
    const bool is_first = rows.empty();
    rows += "|";
    for (const auto& [heading, value] : row_of(result)) {
      if (is_first) headings += fmt::format(" {} |", heading), line += " ---: |";
      rows += fmt::format(" {} |", value);
    }
    rows += "\n";
  }
  return headings + "\n" + line + "\n" + rows;
}

void run(const Options& options) {
  prepare({.cache_folder = options.cache, .database = "DB_open_pinch"});
  ordered_json results = ordered_json::array();
  for (const int count : options.postures) {
    results.push_back(measure(count, options));
    if (!options.output.empty()) write_file(options.output, results.dump(1) + "\n");
  }
  fmt::print("{}", table_of(results));
}

}  // namespace
}  // namespace glovebench::bench

int main(int argc, char** argv) {
  using namespace glovebench::bench;
  Options options;
  CLI::App program("What databases of many postures cost: building, loading, look-ups, memory.");
  program.add_option("postures", options.postures, "how many, for each database")
      ->required()
      ->check(CLI::Range(1, 200'000));
  program.add_flag("--normal-memory", options.normal_memory, "databases that store their distance fields");
  program.add_option("--cascade", options.cascade, "stages of 64 px")->capture_default_str();
  CLI::Option* folder = program.add_option("--folder", options.folder,
                                           "where the databases are built [a new one in the temporary directory]");
  program.add_flag("--keep", options.keep, "keeps the databases in --folder, and takes what an earlier run kept")
      ->needs(folder);
  program.add_option("--cache", options.cache,
                     "of the database that the frames are tracked with [GLOVEBENCH_CACHE or ~/.cache/glovebench]");
  program.add_option("--threads", options.threads, "that build and load")->capture_default_str();
  program.add_option("-o,--output", options.output, "results as JSON");
  CLI11_PARSE(program, argc, argv);
  try {
    if (options.cache.empty()) options.cache = default_cache_folder();
    const bool is_new = options.folder.empty();
    if (is_new) options.folder = new_temporary_folder();
    run(options);
    if (is_new) std::filesystem::remove(options.folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "glovebench_scale: {}\n", error.what());
    return 2;
  }
}
