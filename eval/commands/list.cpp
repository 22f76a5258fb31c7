#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/hand/hand_model.h"
#include "core/methods/method.h"
#include "core/robot/command_limits.h"
#include "eval/commands/flags.h"
#include "eval/commands/help.h"
#include "eval/program.h"
#include "eval/robot_kinematics.h"
#include "eval/studies/study.h"
#include "eval/suite.h"
#include "eval/terminal.h"
#include "render/noise/noise_model.h"
#include "render/subjects/subject.h"
#include "reports/metrics/metric.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::eval {
namespace {

void list_trajectories() {
  for (const auto& listing : trajectories::list_trajectories(trajectory_folder())) {
    const trajectories::Trajectory t = trajectories::load_trajectory(listing.path);
    fmt::print("{:<5}{:<10}{:>4} frames  {}  {}\n", t.name, to_string(t.kind), t.frames.size(),
               trajectories::hash(t), t.description);
  }
}

void list_databases() {
  for (const std::string& name : trajectories::posture_set_names()) {
    const PostureSet set = trajectories::posture_set(trajectory_folder(), name);
    fmt::print("{}: {}\n", name, fmt::join(set.posture_names, ", "));
  }
}

void list_suites() {
  for (const std::string& name : suite_names()) fmt::print("{:<8} {}\n", name, load_suite(name).description);
}

void list_studies() {
  for (const Study& study : studies()) fmt::print("{:<14}{}\n", study.name, study.title);
}

template <typename Entry, std::span<const Entry> (*entries)()>
void list_entries() {
  for (const Entry& entry : entries()) fmt::print("{:<16} {}\n", entry.name, entry.description);
}

void list_formats() {
  for (const trajectories::Format& format : trajectories::formats())
    fmt::print("{:<16} {:<10} {}\n", format.name, format.ending, format.description);
}

void list_metrics() {
  for (const reports::Metric& metric : reports::metrics())
    fmt::print("{:<36}{:<11}{}\n", metric.key, metric.gate ? "compared" : "", metric.description);
}

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
  fmt::print("{}", mapping_table(HandModel::load(hand_mesh_path()).skeleton(), trajectory_folder(), coupling));
}

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
  list.subcommand("methods", "Ways to track, for --method.").runs(list_entries<MethodEntry, methods>);
  list.subcommand("alignments", "Ways to align the hand with the cloud, for `icp.algorithm` of a configuration.")
      .runs(list_entries<AlignmentEntry, alignments>);
  list.subcommand("look-ups", "Ways to search the database, for `lookup.implementation` of a configuration.")
      .runs(list_entries<LookUpEntry, look_ups>);
  list.subcommand("noises", "How the depth camera errs, for --noise.")
      .runs(list_entries<render::DepthNoise, render::depth_noises>);
  list.subcommand("formats", "Files of movements and postures, and captures for `glovebench import`.")
      .runs(list_formats);
  list.subcommand("metrics", "What is measured of each frame, and which of it `compare` and `gate` compare.")
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
  const auto common = std::make_shared<CommonFlags>();
  const Command config = list.subcommand("config", "The tracker's configuration as JSON, as --config takes it.");
  common->add_tracker(config);
  config.runs([common] { fmt::print("{}\n", to_json(common->tracker_config()).dump(2)); });
  list.runs([list] { fmt::print("What can be listed:\n{}", commands_text(list.text(), terminal_columns())); });
}

}  // namespace glovebench::eval
