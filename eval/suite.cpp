#include "eval/suite.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/registry.h"
#include "core/base/text.h"
#include "eval/program.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using reports::ExperimentKey;
using reports::TruthKind;
using trajectories::Trajectory;

constexpr uint64_t kLargestSuite = uint64_t{1} << 20;  // bytes
constexpr int64_t kMaxSeed = 4'294'967'295;
constexpr int kMaxFrame = 1'000'000;
constexpr double kMaxNoiseFactor = 100;
constexpr int kMostExperiments = 10'000;

bool is_database_file(const std::string& name) {
  return name.ends_with(kDatabaseEnding) || trajectories::is_posture_file(name);
}

reports::NoiseSetting noise_from(const JsonCursor& field) {
  field.expect_keys({"model", "factor"});
  const JsonCursor model = field["model"];
  const std::vector<std::string> known = names_in(render::depth_noises());
  if (std::ranges::find(known, model.text()) == known.end()) model.fail(one_of(known, model.text()));
  return {model.text(), field["factor"].number(0, kMaxNoiseFactor)};
}

FrameRange frames_from(const JsonCursor& field) {
  field.expect_keys({"first"}, {"count"});
  FrameRange range{static_cast<int>(field["first"].integer(0, kMaxFrame)), {}};
  if (field.has("count")) range.count = static_cast<int>(field["count"].integer(1, kMaxFrame));
  return range;
}

/// The names of a family's movements: those of consecutive seeds.
std::vector<std::string> movements_from(const JsonCursor& family_field, const JsonCursor& field) {
  const std::vector<std::string> known = trajectories::movement_family_names();
  if (std::ranges::count(known, family_field.text()) == 0) family_field.fail(one_of(known, family_field.text()));
  const trajectories::MovementFamily& family = trajectories::find_movement_family(family_field.text());
  field.expect_keys({"first", "count"});
  const int64_t count = field["count"].integer(1, kMostExperiments);
  const int64_t first = field["first"].integer(0, static_cast<int64_t>(trajectories::kMostMovements) - count + 1);
  std::vector<std::string> names;
  for (int64_t i = 0; i < count; ++i) names.push_back(movement_name(family, static_cast<uint64_t>(first + i)));
  return names;
}

/// Consecutive subjects, who perform an entry's movements in turn.
struct Subjects {
  int first = 1;
  int count = 1;
};

Subjects subjects_from(const JsonCursor& entry) {
  if (entry.has("subject")) {
    if (entry.has("subjects")) entry["subjects"].fail("either subject or subjects");
    return {static_cast<int>(entry["subject"].integer(1, render::kSubjectCount)), 1};
  }
  if (!entry.has("subjects")) return {};
  const JsonCursor field = entry["subjects"];
  field.expect_keys({"first", "count"});
  const auto count = static_cast<int>(field["count"].integer(1, render::kSubjectCount));
  return {static_cast<int>(field["first"].integer(1, render::kSubjectCount - count + 1)), count};
}

/// An entry of a suite's file: a trajectory, or movements of a family.
std::vector<SuiteEntry> entries_from(const JsonCursor& field, const fs::path& folder) {
  const bool is_family = field.has("family");
  if (is_family)
    field.expect_keys({"family", "movements", "databases"}, {"subject", "subjects", "noise", "frames"});
  else
    field.expect_keys({"trajectory", "truth", "databases"}, {"subject", "noise", "frames"});
  SuiteEntry entry;
  entry.truth = is_family ? TruthKind::source : field["truth"].one_of<TruthKind>();
  for (const JsonCursor& item : field["databases"].some_items()) {
    const std::string database = item.text();
    entry.databases.push_back(is_database_file(database) ? (folder / database).string() : database);
  }
  if (field.has("noise")) entry.noise = noise_from(field["noise"]);
  if (field.has("frames")) entry.frames = frames_from(field["frames"]);
  const Subjects subjects = subjects_from(field);
  std::vector<SuiteEntry> entries;
  for (const std::string& name :
       is_family ? movements_from(field["family"], field["movements"]) : std::vector{field["trajectory"].text()}) {
    entry.subject = subjects.first + static_cast<int>(entries.size()) % subjects.count;
    entries.push_back(entry);
    entries.back().trajectory = trajectories::is_trajectory_file(name) ? (folder / name).string() : name;
  }
  return entries;
}

std::vector<uint64_t> seeds_from(const JsonCursor& field) {
  std::vector<uint64_t> seeds;
  for (const JsonCursor& item : field.some_items()) {
    const auto seed = static_cast<uint64_t>(item.integer(0, kMaxSeed));
    if (std::ranges::count(seeds, seed) > 0) item.fail("each seed once");
    seeds.push_back(seed);
  }
  return seeds;
}

/// The experiments of a suite. A repeated one would weigh double.
std::vector<SuiteEntry> experiments_from(const JsonCursor& field, const fs::path& folder) {
  std::vector<SuiteEntry> all;
  std::set<std::string> seen;
  for (const JsonCursor& item : field.some_items()) {
    for (const SuiteEntry& entry : entries_from(item, folder)) {
      for (size_t d = 0; d < entry.databases.size(); ++d) {
        const ExperimentKey key{entry.trajectory, entry.databases[d], *entry.truth, entry.subject, entry.noise};
        if (!seen.insert(to_string(key)).second)
          item["databases"].items()[d].fail("an experiment that is not yet in the suite");
        if (seen.size() > kMostExperiments)
          item.fail("one more experiment", fmt::format("at most {} in a suite", kMostExperiments));
      }
      all.push_back(entry);
    }
  }
  return all;
}

/// By name or file, and truth.
using Truths = std::map<std::pair<std::string, std::optional<TruthKind>>, std::shared_ptr<const Trajectory>>;

/// Loads each trajectory once.
Truths load_truths(const std::vector<SuiteEntry>& entries, Side side) {
  Truths truths;
  for (const SuiteEntry& entry : entries) {
    const std::pair place{entry.trajectory, entry.truth};
    if (truths.contains(place)) continue;
    const auto loaded = std::make_shared<const Trajectory>(load_truth(entry.trajectory, entry.truth));
    if (loaded->side != side) {
      throw Error(entry.trajectory, "side", std::string(to_string(loaded->side)),
                  "that of the run's other trajectories");
    }
    for (const auto& [known, other] : truths)
      if (other->name == loaded->name && other->kind == loaded->kind)
        throw Error(entry.trajectory, "name", loaded->name, "one not yet in the run");
    truths[place] = loaded;
  }
  return truths;
}

bool matches(const std::string& filter, const std::string& name) {
  return filter.empty() || fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

/// Runs of the first seed that share images and noise, one per database.
using SameFrames = std::vector<RunSpec>;

/// The experiments that match the filter.
std::vector<SameFrames> experiments_of(Workbench& workbench, const TrackerConfig& tracker, const Suite& suite,
                                       const std::string& filter) {
  const Truths truths = load_truths(suite.entries, workbench.config().side);
  std::vector<SameFrames> groups;
  std::vector<std::string> experiments;
  for (const SuiteEntry& entry : suite.entries) {
    RunSpec wanted{truths.at({entry.trajectory, entry.truth}), entry.frames, entry.subject, entry.noise,
                   suite.seeds.front()};
    wanted.tracker = tracker;
    wanted.appearance = entry.appearance;
    if (const auto movement = trajectories::find_movement(entry.trajectory))
      wanted.setting = movement->family->name;
    frames_of(wanted);  // throws if the trajectory lacks them
    for (const std::string& database : entry.databases) {
      wanted.database = workbench.add_database(database);
      const std::string experiment = to_string(key_of(wanted));
      if (std::ranges::count(experiments, experiment) > 0)
        throw Error(database, "experiment", experiment, "one not yet in the run");
      experiments.push_back(experiment);
      if (!matches(filter, experiment)) continue;
      auto group = std::ranges::find_if(groups, [&](const SameFrames& specs) {
        return share_images(specs.front(), wanted) && specs.front().noise == wanted.noise;
      });
      if (group == groups.end()) group = groups.insert(group, SameFrames{});
      group->push_back(wanted);
    }
  }
  if (groups.empty()) {
    constexpr size_t shown = 3;
    const bool all = experiments.size() <= shown;
    experiments.resize(std::min(shown, experiments.size()));
    throw Error(
        "--filter", "pattern", quoted_excerpt(filter),
        fmt::format("one that matches {}{}", fmt::join(experiments, ", "), all ? "" : ", ... (see --list)"));
  }
  return groups;
}

}  // namespace

Suite parse_suite(std::string_view text, const std::string& path) {
  const nlohmann::json document = parse_json(text, path);
  const JsonCursor root(document, path);
  root.expect_keys({"format", "version", "name", "description", "seeds", "experiments"});
  root.expect_format("glovebench-suite", 1);
  return {root["name"].name(), root["description"].text(), seeds_from(root["seeds"]),
          experiments_from(root["experiments"], fs::path(path).parent_path())};
}

Suite load_suite(const std::string& name_or_file) {
  if (name_or_file.ends_with(".json")) return parse_suite(read_file(name_or_file, kLargestSuite), name_or_file);
  const std::vector<std::string> known = suite_names();
  if (std::ranges::count(known, name_or_file) == 0)
    throw Error("suites", "name", name_or_file, "a file (*.json) or " + one_of(known, name_or_file));
  const std::string path = fmt::format("{}/{}.json", suite_folder(), name_or_file);
  Suite suite = parse_suite(read_file(path, kLargestSuite), path);
  if (suite.name != name_or_file) throw Error(path, "name", suite.name, name_or_file);
  return suite;
}

std::vector<std::string> suite_names() { return trajectories::json_names(suite_folder()); }

Side side_of(const Suite& suite) {
  const SuiteEntry& first = suite.entries.at(0);
  return load_truth(first.trajectory, first.truth).side;
}

Plan plan_suite(Workbench& workbench, const TrackerConfig& tracker, const Suite& suite, const std::string& filter) {
  Plan plan{tracker, {}, suite.name};
  for (const SameFrames& first_seed : experiments_of(workbench, tracker, suite, filter)) {
    for (const uint64_t seed : suite.seeds) {
      for (const RunSpec& spec : first_seed) {
        plan.specs.push_back(spec);
        plan.specs.back().seed = seed;
      }
    }
  }
  return plan;
}

}  // namespace glovebench::eval
