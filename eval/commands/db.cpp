#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/terminal.h"
#include "render/label_renderer.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

struct Build {
  CommonFlags common;
  std::string postures;

  void run() {
    const bool is_file = trajectories::is_posture_file(postures);
    const PostureSet set = is_file ? trajectories::load_posture_set(postures)
                                   : trajectories::posture_set(trajectory_folder(), postures);
    if (const std::string doubt = trajectories::angle_doubt(set.postures); !doubt.empty())
      say("glovebench: warning: {}: {}\n", postures, doubt);
    Workbench workbench = common.workbench();
    Progress progress("building " + set.name, common.quiet);
    const HandModel& model = *workbench.model();
    const WorkbenchConfig& config = workbench.config();
    const std::string content = Database::build_file(
        common.output, set, model, config.views, render::label_renderer_factory(), config.threads,
        [&](double share) { progress.show(share); }, kTinySizes, config.memory);
    if (common.quiet) return;
    fmt::print("{}: {} postures x {} views = {} entries, content {}\n", common.output, set.postures.size(),
               kViewCount, set.postures.size() * kViewCount, content);
  }
};

void show(const std::string& path) {
  const Database database = Database::load(path);  // read completely, to find damage
  database.check();
  const double bytes = static_cast<double>(std::filesystem::file_size(path));
  fmt::print("{}: {}, {} hand, {} entries of {:.0f} bytes, {} memory, content {}\n", path,
             database.posture_set().name, database.side() == Side::right ? "right" : "left", database.entry_count(),
             bytes / database.entry_count(), to_string(database.memory()), database.content_hash());
  for (const std::string& name : database.posture_set().posture_names) fmt::print("  {}\n", name);
}

}  // namespace

void add_db(Command program) {
  const Command db = program.subcommand("db", "Build and look into databases of tiny images.");

  const auto state = std::make_shared<Build>();
  const Command build = db.subcommand("build", "Render the 756 views of each posture and store their tiny images.");
  build
      .option("--postures", state->postures,
              "file (*.csv, *.json; trajectories/README.md) or the name of a posture set")
      .required();
  state->common.add_output(build, "database file to write (*.glovedb)").required();
  build.option("--left", state->common.left, "a left hand");
  state->common.add_hand(build);
  state->common.add_machine(build);
  build.runs([state] { state->run(); });

  const auto path = std::make_shared<std::string>();
  const Command info = db.subcommand("info", "Print what a database file holds.");
  info.option("file", *path, "database file").required();
  info.runs([path] { show(*path); });
}

}  // namespace glovebench::eval
