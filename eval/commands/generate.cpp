#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/hand/hand_model.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/terminal.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::eval {
namespace {

struct Generate {
  CommonFlags common;
  std::string family_name;
  int count = 10;
  int frames = trajectories::kMovementFrames;
  double distance_deg = trajectories::kGestureDistanceDeg;

  void run() {
    const trajectories::MovementFamily& family = trajectories::find_movement_family(family_name);
    const std::vector<uint64_t> seeds = common.seeds(count);
    if (seeds.back() > trajectories::kMostMovements) {
      throw Error("--seed", "value", fmt::format("{} for the last movement", seeds.back()),
                  fmt::format("at most {}", trajectories::kMostMovements));
    }
    common.check_output_folder();
    trajectories::MovementMaterial material =
        trajectories::load_movement_material(trajectory_folder(), HandModel::load(hand_mesh_path()).skeleton());
    material.least_distance_deg = distance_deg;
    WholeFiles files(common.output);
    std::string lines;
    Progress progress("generating", common.quiet);
    for (size_t i = 0; i < seeds.size(); ++i) {
      const trajectories::Trajectory movement = generate_movement(family, seeds[i], material, frames);
      const std::string name = movement.name + ".json";
      files.add(name, canonical_text(movement));
      lines += fmt::format("{}/{}: {} frames, hash {}\n", common.output, name, frames, hash(movement));
      progress.show(static_cast<double>(i + 1) / static_cast<double>(seeds.size()));
    }
    files.commit();
    if (!common.quiet) fmt::print("{}", lines);
  }
};

}  // namespace

void add_generate(Command program) {
  const Command command = program.subcommand(
      "generate",
      "Make movements of a family, each from a seed of its own (`glovebench list families` prints the ranges).\n"
      "`run --trajectory` takes the files, and a movement of 100 frames also by its name alone, e.g. side_3.");
  const auto state = std::make_shared<Generate>();
  command.option("--family", state->family_name, "what kind of movement")
      .required()
      .one_of(trajectories::movement_family_names());
  state->common.add_output(command, "folder for the trajectory files, FAMILY_SEED.json").required();
  command.option("--count", state->count, "movements").in(1, 1000);
  command.option("--frames", state->frames, "of each, at 15 Hz").in(1, 10000);
  command.option("--seed", state->common.seed, "of the first movement; each further one has the next")
      .not_negative();
  command
      .option("--distance", state->distance_deg,
              "least distance of each posture from each gesture, deg RMS over the fingers' 20 angles")
      .in(0, 180);
  command.option("-q,--quiet", state->common.quiet, "no progress");
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
