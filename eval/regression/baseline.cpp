#include "eval/regression/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/file_set.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/whole_file.h"
#include "eval/program.h"
#include "eval/run_store.h"
#include "eval/suite.h"
#include "reports/results_json.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using reports::Incomparable;

constexpr const char *kResults = "results.json", *kNoiseFloor = "noise_floor.json", *kSpeed = "speed.json",
                     *kProvenance = "provenance.json", *kTimings = "timings.json";
constexpr std::string_view kProvenanceFormat = "glovebench-provenance";

/// Names no machine, since the file is committed.
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

/// Throws Incomparable unless the file matches the set's manifest.
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

/// The run's folder, also if a file in it was given.
std::string folder_of(const std::string& folder_or_file) {
  std::error_code error;
  return fs::is_directory(folder_or_file, error) ? folder_or_file : folder_above(folder_or_file);
}

/// Throws: Error for the folder of `run` with several settings, each of which is a run.
void refuse_several(const std::string& folder) {
  std::vector<std::string> runs;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        !name.starts_with(".") && fs::exists(entry.path() / kResults, ignored))
      runs.push_back(entry.path().string());
  std::ranges::sort(runs);
  if (!runs.empty())
    throw Error(folder, "run", "a folder of runs", fmt::format("one of {}", fmt::join(runs, ", ")));
}

reports::NamedResult results_of(const FileSet& files) {
  return {files.path(kResults), reports::parse_results(read_of(files, kResults), files.path(kResults))};
}

/// Describes the baseline to be replaced; null if there is none. Throws Error if its truth differs from the run's.
Json describe_replaced(const FileSet& files, const reports::NamedResult& run) {
  if (!files.has(kResults)) return nullptr;
  const std::string text = files.find(kResults, kLargestResults).content;
  const reports::RunResult old = reports::parse_results(text, files.path(kResults));
  for (const auto& [name, hash] : run.result.inputs.truths) {
    const auto found = old.inputs.truths.find(name);
    if (found == old.inputs.truths.end() || found->second == hash) continue;
    throw Error(run.name, "inputs.truths." + name, hash,
                fmt::format("{} (the baseline's; if the truth was meant to change, delete {} first)", found->second,
                            files.path(kResults)));
  }
  return {{"commit", old.commit}, {"results_hash", hash_text(text)}};
}

/// Finds a change by hand: the results must have the hash of the provenance.
void require_same_bytes(const FileSet& files) {
  const std::string expected = read_provenance(files).results_hash, found = hash_text(read_of(files, kResults));
  if (found != expected) {
    throw Incomparable(files.path(kResults), "hash", found,
                       expected + ", as provenance.json says (update it again)");
  }
}

}  // namespace

Provenance parse_provenance(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format(kProvenanceFormat, 1);
  return {json["results_hash"].text(), reports::stage_times_from(json["times"])};
}

std::string default_baseline_folder(const std::string& suite) { return "ci/baselines/" + suite; }

FinishedRun load_finished_run(const std::string& folder_or_file) {
  const std::string folder = folder_of(folder_or_file);
  require_finished(folder);
  const FileSet files(folder);
  if (folder == folder_or_file && !files.has(kResults)) refuse_several(folder);
  if (folder == folder_or_file) return {files, results_of(files)};
  const std::string name = fs::path(folder_or_file).filename().string();
  if (name == kResults && files.has(name)) return {files, results_of(files)};
  // Another file is not part of the run and is read alone.
  return {files, {folder_or_file, reports::read_results(folder_or_file)}};
}

std::optional<reports::NoiseFloor> load_noise_floor_beside(const FileSet& files) {
  const std::string path = files.path(kNoiseFloor);  // written alone, in no set
  if (!fs::exists(path)) return std::nullopt;
  return reports::parse_noise_floor(read_regular_file(path, kLargestSmallFile), path);
}

reports::StageTimes load_stage_times(const FileSet& files) {
  if (files.has(kTimings)) return reports::parse_stage_times(read_of(files, kTimings), files.path(kTimings));
  if (!files.has(kProvenance)) return {};
  return read_provenance(files).times;
}

Baseline load_baseline(const std::string& folder) {
  const FileSet files(folder);
  for (const char* name : {kResults, kProvenance})
    if (!files.has(name))
      throw Incomparable(files.path(name), "baseline", "none", "that of an earlier run (glovebench gate --update)");
  require_finished(folder);
  require_same_bytes(files);
  Baseline baseline{{files, results_of(files)}, load_noise_floor_beside(files), {}, load_stage_times(files)};
  if (files.has(kSpeed)) baseline.speed = reports::parse_speed_ratios(read_of(files, kSpeed), files.path(kSpeed));
  return baseline;
}

Suite suite_of(const reports::NamedResult& run, const std::string& name_or_file) {
  const std::string& name = run.result.suite;
  if (name.empty()) throw Error(run.name, "suite", "none", "the run of a suite (run --suite)");
  const std::vector<std::string> known = suite_names();
  const bool is_known = std::ranges::find(known, name) != known.end();
  if (name_or_file.empty() && !is_known)
    throw Error(run.name, "suite", name, fmt::format("{}, or the suite's file as --suite", fmt::join(known, ", ")));
  Suite suite = load_suite(name_or_file.empty() ? name : name_or_file);
  if (suite.name != name) throw Error(run.name, "suite", name, suite.name);
  return suite;
}

void update_baseline(const std::string& folder, const reports::NamedResult& run, const std::optional<Suite>& suite,
                     const std::vector<reports::SpeedRatio>& speed, const reports::StageTimes& times,
                     const std::vector<std::string>& accepted) {
  if (suite) require_whole_suite(run, *suite);
  WholeFiles files(folder);  // first, since it finishes an update that a kill interrupted
  const FileSet old(folder);
  if (old.has(kTimings)) throw Error(folder, "baseline", "a run", "a folder of its own");
  Json replaced = describe_replaced(old, run);
  if (!replaced.is_null()) replaced["accepted"] = accepted;
  const std::string results = reports::results_json(run.result);
  files.add(kProvenance, provenance_json(run, hash_text(results), times, replaced));
  if (!speed.empty()) files.add(kSpeed, reports::speed_json(speed));
  if (speed.empty() && old.has(kSpeed)) files.add(kSpeed, old.find(kSpeed, kLargestResults).content);
  files.add(kResults, results);
  files.commit();
}

}  // namespace glovebench::eval
