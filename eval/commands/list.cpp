#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/hand/hand_model.h"
#include "core/methods/method.h"
#include "core/robot/command_limits.h"
#include "eval/commands/flags.h"
#include "eval/commands/help.h"
#include "eval/frame_formats/frame_format.h"
#include "eval/program.h"
#include "eval/robot_kinematics.h"
#include "eval/studies/study.h"
#include "eval/suite.h"
#include "eval/terminal.h"
#include "render/noise/noise_model.h"
#include "render/subjects/subject.h"
#include "reports/metrics/glossary.h"
#include "reports/terminal_table.h"
#include "reports/text.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::eval {
namespace {

/// Prints the columns of an entry and its meaning beside them, broken to fit.
void print_entry(const std::string& columns, std::string_view meaning) {
  fmt::print("{}{}", columns, reports::wrapped(std::string(meaning), terminal_columns(), columns.size()));
}

void list_trajectories() {
  constexpr size_t kHashIndent = 28;
  for (const auto& listing : trajectories::list_trajectories(trajectory_folder())) {
    const trajectories::Trajectory t = trajectories::load_trajectory(listing.path);
    print_entry(fmt::format("{:<5}{:<10}{:>4} frames  ", t.name, to_string(t.kind), t.frames.size()),
                t.description);
    print_entry(std::string(kHashIndent, ' '), "hash " + trajectories::hash(t));
  }
}

void list_databases() {
  for (const std::string& name : trajectories::posture_set_names()) {
    const PostureSet set = trajectories::posture_set(trajectory_folder(), name);
    print_entry(fmt::format("{:<21}", name), fmt::format("{}", fmt::join(set.posture_names, ", ")));
  }
}

void list_suites() {
  for (const std::string& name : suite_names())
    print_entry(fmt::format("{:<9}", name), load_suite(name).description);
}

void list_studies() {
  for (const Study& study : studies()) print_entry(fmt::format("{:<14}", study.name), study.title);
}

template <typename Entry, std::span<const Entry> (*entries)()>
void list_entries() {
  for (const Entry& entry : entries()) print_entry(fmt::format("{:<17}", entry.name), entry.description);
}

void list_methods() {
  list_entries<MethodEntry, methods>();
  print_entry(fmt::format("{:<17}", "exec:COMMAND"),
              "a program of yours, run by /bin/sh; `glovebench method test` tries it");
}

void list_formats() {
  for (const trajectories::Format& format : trajectories::formats())
    print_entry(fmt::format("{:<16} {:<10} ", format.name, format.ending), format.description);
}

void list_metrics() { fmt::print("{}", reports::glossary_text(terminal_columns())); }

void list_subjects() {
  fmt::print(
      " 1 the tracker's own hand\n 2 the tracker's mesh, 5% larger, with other segments, borders and dyes\n");
  for (int number = render::kFirstCapsuleSubject; number <= render::kSubjectCount; ++number) {
    const render::HandDimensions hand = render::draw_dimensions(static_cast<uint64_t>(number));
    fmt::print("{:>2} {:<5} {:.0f} mm long, {:.0f} mm broad: tapered capsules\n", number,
               hand.woman ? "woman" : "man", 1000 * hand.length, 1000 * hand.breadth);
  }
}

void list_angles() {
  for (const AngleInfo& info : angle_infos())
    fmt::print("{:<24}{:>5} to {:>4} deg\n", info.name, info.min_deg, info.max_deg);
}

void list_mapping(ShadowCoupling coupling) {
  const reports::Table table =
      mapping_table(HandModel::load(hand_mesh_path()).skeleton(), trajectory_folder(), coupling);
  fmt::print("{}\n{}", reports::wrapped(table.explanation, terminal_columns()),
             reports::to_terminal(table, terminal_columns()));
}

/// True if `word` stands in the text, in any case, with no letter or digit beside it.
bool has_word(std::string text, std::string word) {
  const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
  std::ranges::transform(text, text.begin(), lower);
  std::ranges::transform(word, word.begin(), lower);
  const auto is_apart = [&](size_t at) {
    return at >= text.size() || !std::isalnum(static_cast<unsigned char>(text[at]));
  };
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || is_apart(at - 1)) && is_apart(at + word.size())) return true;
  return false;
}

/// The fields that name `word`, or all, with their values in `config`.
std::string explained_config(const TrackerConfig& config, const std::string& word) {
  constexpr size_t kIndent = 4;
  const size_t columns = terminal_columns();
  std::string all;
  for (const ConfigField& field : config_fields(config)) {
    std::string plain(field.what.field), text = fmt::format("{} = {}\n", field.what.field, field.value);
    const auto add = [&](const std::string& line) {
      plain += " " + line;
      text += std::string(kIndent, ' ') + reports::wrapped(line, columns, kIndent);
    };
    add(std::string(field.what.meaning));
    add(fmt::format("{}{}{}", field.range, field.unit.empty() ? "" : ", unit ", field.unit));
    add(field.what.paper.empty() ? "not in the paper" : fmt::format("paper: {}", field.what.paper));
    if (word.empty() || has_word(plain, word)) all += text;
  }
  if (all.empty())
    throw Error("list config", "word", word, "a word in a field's name or meaning, or in the paper's words for it");
  return all;
}

struct ListConfig {
  CommonFlags common;
  bool explain = false;
  std::string word;

  void run() const {
    if (explain || !word.empty()) return fmt::print("{}", explained_config(common.tracker_config(), word));
    fmt::print("{}\n", to_json(common.tracker_config()).dump(2));
  }
};

}  // namespace

void add_list(Command program) {
  const Command list =
      program.subcommand("list", "Print what the program knows; without a COMMAND, what can be listed.");
  list.subcommand("trajectories", "The ground truths and other movements, with their hashes.")
      .runs(list_trajectories);
  list.subcommand("families", "The families of movements, for `glovebench generate`, with their ranges.").runs([] {
    fmt::print("{}", trajectories::movement_families_text());
  });
  list.subcommand("databases", "The posture databases.").runs(list_databases);
  list.subcommand("suites", "Experiments that belong together, for `glovebench run --suite`.").runs(list_suites);
  list.subcommand("studies", "Parts of `glovebench reproduce`, also for `glovebench run`.").runs(list_studies);
  list.subcommand("methods", "Ways to track, for --method.").runs(list_methods);
  list.subcommand("alignments", "Ways to align the hand with the cloud, for `icp.algorithm` of a configuration.")
      .runs(list_entries<AlignmentEntry, alignments>);
  list.subcommand("look-ups", "Ways to search the database, for `lookup.implementation` of a configuration.")
      .runs(list_entries<LookUpEntry, look_ups>);
  list.subcommand("noises", "How the depth camera errs, for --noise.")
      .runs(list_entries<render::DepthNoise, render::depth_noises>);
  list.subcommand("formats", "Files of movements and postures, and captures for `glovebench import`.")
      .runs(list_formats);
  list.subcommand("datasets", "Formats of frames, for `glovebench render --format`.")
      .runs(list_entries<FrameFormat, frame_formats>);
  list.subcommand("metrics",
                  "What is measured, by which formula, over which frames; what `compare` and `gate` judge.")
      .runs(list_metrics);
  list.subcommand("subjects", "The hands in front of the camera, for --subject.").runs(list_subjects);
  list.subcommand("angles", "The 22 joint angles and their limits.").runs(list_angles);
  const auto limits = std::make_shared<LimitsFlag>();
  const Command mapping =
      list.subcommand("mapping", "How far the robot hand's fingertips are from the human's, by way of mapping.");
  limits->add_coupling(mapping);
  mapping.runs([limits] { list_mapping(limits->limits().coupling); });
  list.subcommand("limits", "What robot commands may do, as JSON, as --robot-limits takes it.").runs([] {
    fmt::print("{}\n", to_json(CommandLimits()).dump(2));
  });
  const auto shown = std::make_shared<ListConfig>();
  const Command config = list.subcommand("config", "The tracker's configuration as JSON, as --config takes it.");
  config.option("--explain", shown->explain,
                "instead: each field's default, meaning, range, unit, place in the paper");
  config.option("word", shown->word, "explain only the fields with this word, also of the paper: k, sub-sampling");
  shown->common.add_tracker(config);
  config.runs([shown] { shown->run(); });
  list.runs([list] { fmt::print("What can be listed:\n{}", commands_text(list.text(), terminal_columns())); });
}

}  // namespace glovebench::eval
