#include "eval/regression/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/file_set.h"
#include "core/base/hash.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/read_limits.h"
#include "eval/program_info.h"
#include "eval/run_folder.h"
#include "eval/suite.h"
#include "reports/json_text.h"
#include "reports/results_json.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using reports::Incomparable;

constexpr const char *kResults = "results.json", *kNoiseFloor = "noise_floor.json", *kSpeed = "speed.json",
                     *kProvenance = "provenance.json", *kTimings = "timings.json";
constexpr std::string_view kProvenanceFormat = "glovebench-provenance";

std::string in(const std::string& folder, const char* file) {
  return folder + "/" + file;
}

/// What the baseline was made by. No name of a machine: the file is committed.
std::string provenance_json(const reports::NamedResult& run, const std::string& results_hash,
                            const reports::StageTimes& times, const Json& replaced) {
  const reports::Timings here = host_timings(1);
  return reports::format_json({{"format", kProvenanceFormat},
                               {"version", 1},
                               {"suite", run.result.suite},
                               {"results_hash", results_hash},
                               {"program_version", run.result.program_version},
                               {"commit", run.result.commit},
                               {"updated", here.date},
                               {"compiler", here.compiler},
                               {"build_type", here.build_type},
                               {"times", reports::stage_times_json(times)},
                               {"replaced", replaced}});
}

/// Throws Incomparable unless the file is what the set's manifest says.
std::string read_of(const FileSet& set, const std::string& name) {
  try {
    return set.read(name, kLargestResults);
  } catch (const BrokenSet& e) {
    throw Incomparable(e.what());
  }
}

Provenance read_provenance(const FileSet& set) {
  return parse_provenance(read_of(set, kProvenance), set.path(kProvenance));
}

/// The replaced baseline in a few words; null if there was none.
Json describe_replaced(const std::string& folder) {
  if (!fs::exists(in(folder, kResults))) return nullptr;
  const reports::RunResult old = reports::read_results(in(folder, kResults));
  return {{"commit", old.commit}, {"results_hash", hash_file(in(folder, kResults))}};
}

void require_whole_suite(const reports::NamedResult& run, const Suite& suite) {
  size_t expected = 0;
  for (const SuiteEntry& entry : suite.entries) expected += entry.databases.size();
  if (run.result.experiments.size() != expected) {
    throw Error(run.name, "experiments", fmt::format("{}", run.result.experiments.size()),
                fmt::format("all {} of suite {}", expected, suite.name));
  }
  for (const reports::ExperimentResult& experiment : run.result.experiments) {
    std::vector<uint64_t> seeds;
    for (const reports::SeedRun& seed_run : experiment.runs) seeds.push_back(seed_run.seed);
    if (seeds == suite.seeds) continue;
    throw Error(run.name, "seeds of " + to_string(experiment.key), fmt::format("{}", fmt::join(seeds, ", ")),
                fmt::format("those of suite {}: {}", suite.name, fmt::join(suite.seeds, ", ")));
  }
}

void require_same_truths(const std::string& folder, const reports::NamedResult& run) {
  if (!fs::exists(in(folder, kResults))) return;
  const reports::RunResult old = reports::read_results(in(folder, kResults));
  for (const auto& [name, hash] : run.result.inputs.truths) {
    const auto found = old.inputs.truths.find(name);
    if (found == old.inputs.truths.end() || found->second == hash) continue;
    throw Error(run.name, "inputs.truths." + name, hash,
                fmt::format("{} (the baseline's; if the truth was meant to change, delete {} first)", found->second,
                            in(folder, kResults)));
  }
}

/// The results are those that the provenance speaks of: an update that was killed, or a change by hand, is found.
void require_same_bytes(const std::string& folder) {
  const FileSet set(folder);
  if (!set.has(kProvenance)) return;
  const std::string expected = read_provenance(set).results_hash;
  const std::string found = hash_text(read_of(set, kResults));
  if (found != expected) {
    throw Incomparable(in(folder, kResults), "hash", found,
                       expected + ", as provenance.json says (update it again)");
  }
}

}  // namespace

Provenance parse_provenance(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json["format"].expect_text(kProvenanceFormat);
  json["version"].integer(1, 1);
  return {json["results_hash"].text(), reports::stage_times_from(json["times"])};
}

std::string folder_of(const std::string& folder_or_file) {
  std::error_code error;
  if (fs::is_directory(folder_or_file, error)) return folder_or_file;
  const std::string parent = fs::path(folder_or_file).parent_path().string();
  return parent.empty() ? "." : parent;
}

std::string default_baseline_folder(const std::string& suite) {
  return "ci/baselines/" + suite;
}

reports::NamedResult load_run(const std::string& folder_or_file) {
  require_finished(folder_of(folder_or_file));
  std::error_code error;
  const std::string path = fs::is_directory(folder_or_file, error) ? in(folder_or_file, kResults) : folder_or_file;
  const std::string folder = folder_of(path), name = fs::path(path).filename().string();
  const FileSet set(folder);
  // Another file that somebody put there is no part of the run, and is read as it is.
  if (path == folder_or_file && !set.has(name)) return {path, reports::read_results(path)};
  return {path, reports::parse_results(read_of(set, name), path)};
}

void require_own_folder(const std::string& output, const std::string& run) {
  if (output.empty()) return;
  std::error_code error;
  if (fs::equivalent(output, folder_of(run), error)) {
    throw Error("--output", "folder", output, "another than that of the run itself");
  }
}

std::optional<reports::NoiseFloor> load_noise_floor_beside(const std::string& folder_or_file) {
  const std::string path = in(folder_of(folder_or_file), kNoiseFloor);  // is written by itself, and in no set
  if (!fs::exists(path)) return std::nullopt;
  return reports::read_noise_floor(path);
}

reports::StageTimes load_stage_times_beside(const std::string& folder_or_file) {
  const FileSet set(folder_of(folder_or_file));
  if (set.has(kTimings)) return reports::parse_stage_times(read_of(set, kTimings), set.path(kTimings));
  if (!set.has(kProvenance)) return {};
  return read_provenance(set).times;
}

Baseline load_baseline(const std::string& folder) {
  const std::string path = in(folder, kResults);
  if (!FileSet(folder).has(kResults)) {
    throw Incomparable(path, "baseline", "none",
                       "the results of an earlier run (glovebench gate --update makes it)");
  }
  require_same_bytes(folder);
  Baseline baseline{load_run(folder), load_noise_floor_beside(folder), {}, load_stage_times_beside(folder)};
  if (const FileSet set(folder); set.has(kSpeed))
    baseline.speed = reports::parse_speed_ratios(read_of(set, kSpeed), set.path(kSpeed));
  return baseline;
}

Suite suite_of(const reports::NamedResult& run, const std::string& name_or_file) {
  const std::string& name = run.result.suite;
  if (name.empty()) throw Error(run.name, "suite", "none", "the run of a suite (run --suite)");
  const std::vector<std::string> known = suite_names();
  const bool is_known = std::ranges::find(known, name) != known.end();
  if (name_or_file.empty() && !is_known) {
    throw Error(run.name, "suite", name, fmt::format("{}, or the suite's file as --suite", fmt::join(known, ", ")));
  }
  Suite suite = load_suite(name_or_file.empty() ? name : name_or_file);
  if (suite.name != name) throw Error(run.name, "suite", name, suite.name);
  return suite;
}

void update_baseline(const std::string& folder, const reports::NamedResult& run, const Suite& suite,
                     const std::vector<reports::SpeedRatio>& speed, const reports::StageTimes& times) {
  require_whole_suite(run, suite);
  WholeFiles files(folder, kBaselineSet);  // first: it finishes an update that a kill ended
  require_same_truths(folder, run);
  const Json replaced = describe_replaced(folder);
  const std::string results = reports::results_json(run.result);
  files.add(kProvenance, provenance_json(run, hash_text(results), times, replaced));
  if (speed.empty()) files.keep(kSpeed);
  if (!speed.empty()) files.add(kSpeed, reports::speed_json(speed));
  files.add(kResults, results);
  files.commit();
}

}  // namespace glovebench::eval
