#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "trajectories/capture/import_capture.h"
#include "trajectories/formats/format.h"
#include "trajectories/posture_file.h"

namespace glovebench::eval {
namespace {

struct ImportMarkers {
  std::vector<std::string> files;
  std::string format;
  std::string layout;
  std::string output;
  std::optional<Eigen::Isometry3d> T_capture_camera;  ///< empty: above the hand
  int every = 1;
  std::optional<int> postures;  ///< empty: the trajectory
  bool left = false;

  void run() const {
    const Side side = left ? Side::left : Side::right;
    const trajectories::Format& read = trajectories::find_marker_format(format);
    const bool is_poses = format == "handpose";
    if (files.size() > 1 && !is_poses) {
      throw Error("import markers", "files", fmt::format("{}", files.size()),
                  "one, or several of --format handpose");
    }
    if ((is_poses || postures) && (T_capture_camera || every > 1))
      throw Error("import markers", "options", "--camera or --every with a posture set", "them with a trajectory");
    if (!output.ends_with(".json")) throw Error("--output", "file name", output, "the ending .json");
    const std::string name = std::filesystem::path(output).stem().string();
    const std::string residuals = name + ".residuals.csv";
    if (!is_name(name)) throw Error("--output", "file name", name, kNameExpected);
    std::vector<std::string> inputs = files;
    inputs.push_back(layout);
    for (const std::string& input : inputs)
      require_different_files(
          {{"input", input}, {"--output", output}, {"residuals", folder_above(output) + "/" + residuals}});
    const trajectories::CapturePlacement placement{side, T_capture_camera};
    const trajectories::HandFit fit = trajectories::import_capture(
        files, read, side, trajectories::load_marker_layout(layout), HandModel::load(hand_mesh_path()));
    WholeFiles made(folder_above(output));
    if (is_poses || postures) {
      const size_t count = postures ? static_cast<size_t>(*postures) : fit.frames.size();
      made.add(name + ".json", trajectories::canonical_text(trajectories::postures_of(
                                   fit, name, count, is_poses ? stems() : std::vector<std::string>{})));
    } else {
      made.add(name + ".json",
               trajectories::canonical_text(trajectories::trajectory_of(fit, placement, name, every)));
    }
    made.add(residuals, trajectories::residual_table(fit));
    made.commit();
    fmt::print("{}: {}\n", output, trajectories::summary(fit));
  }

  std::vector<std::string> stems() const {
    std::vector<std::string> names;
    for (const std::string& file : files) names.push_back(std::filesystem::path(file).stem().string());
    return names;
  }
};

}  // namespace

void add_import(Command program) {
  const Command import =
      program.subcommand("import", "Make trajectories and posture sets of what others recorded.");
  const Command command = import.subcommand("markers",
                                            "Fit the hand to captured markers or joint positions: joint angles "
                                            "and pose of every frame, as a trajectory for "
                                            "run and record, or as a posture set for db build. Residuals are "
                                            "written beside it (trajectories/README.md).");
  const auto state = std::make_shared<ImportMarkers>();
  command.option("file", state->files, "capture; several of --format handpose are one set").required();
  command.option("--format", state->format, "of the capture")
      .one_of(trajectories::marker_format_names())
      .required();
  command.option("-o,--output", state->output, "file to write (*.json); its name is the trajectory's").required();
  command.option("--layout", state->layout, "JSON file that says where the markers of other names sit");
  command.option("--postures", state->postures, "instead of the trajectory: that many postures that differ most")
      .in(1, 10000);
  command.option("--every", state->every, "of the trajectory, take every Nth frame").in(1, 100000);
  command.option("--camera", state->T_capture_camera,
                 "the camera in the capture's frame: X Y Z (m) QW QX QY QZ [0.7 m above the back of the hand]");
  command.option("--left", state->left, "a left hand");
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
