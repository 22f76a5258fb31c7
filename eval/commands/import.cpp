#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "eval/commands/command.h"
#include "eval/share.h"
#include "trajectories/capture/import_capture.h"
#include "trajectories/json_field.h"
#include "trajectories/posture_file.h"

namespace glovebench::eval {
namespace {

struct ImportMarkers {
  std::vector<std::string> files;
  std::string format;
  std::string layout;
  std::string output;
  std::vector<double> camera;  ///< x, y, z (m), quaternion w, x, y, z; empty: above the hand
  int every = 1;
  int postures = 0;  ///< 0: the trajectory
  bool left = false;

  void run() const {
    const Side side = left ? Side::left : Side::right;
    const bool is_poses = format == "handpose";
    if (files.size() > 1 && !is_poses) {
      throw Error("import markers", "files", fmt::format("{}", files.size()),
                  "one, or several of --format handpose");
    }
    if ((is_poses || postures > 0) && (!camera.empty() || every > 1)) {
      throw Error("import markers", "options", "--camera or --every with a posture set", "them with a trajectory");
    }
    if (!output.ends_with(".json")) throw Error("--output", "file name", output, "the ending .json");
    const std::string name = std::filesystem::path(output).stem().string();
    if (!is_name(name)) throw Error("--output", "file name", name, kNameExpected);
    const trajectories::CapturePlacement placement{side, T_capture_camera()};
    const trajectories::MarkerLayout markers =
        layout.empty()
            ? trajectories::MarkerLayout{}
            : trajectories::parse_marker_layout(read_file(layout, trajectories::kLargestMarkerLayout), layout);
    const HandModel model = HandModel::load(hand_mesh_path());
    const trajectories::HandFit fit = trajectories::import_capture(files, format, side, markers, model);
    WholeFiles made(folder_above(output));
    if (is_poses || postures > 0) {
      const size_t count = postures > 0 ? static_cast<size_t>(postures) : fit.frames.size();
      made.add(name + ".json", trajectories::canonical_text(trajectories::postures_of(
                                   fit, name, count, is_poses ? stems() : std::vector<std::string>{})));
    } else {
      made.add(name + ".json",
               trajectories::canonical_text(trajectories::trajectory_of(fit, placement, name, every)));
    }
    made.add(name + ".residuals.csv", trajectories::residual_table(fit));
    made.commit();
    fmt::print("{}: {}\n", output, trajectories::summary(fit));
  }

  std::vector<std::string> stems() const {
    std::vector<std::string> names;
    for (const std::string& file : files) names.push_back(std::filesystem::path(file).stem().string());
    return names;
  }

  std::optional<Eigen::Isometry3d> T_capture_camera() const {
    if (camera.empty()) return {};
    const Eigen::Quaterniond q(camera[3], camera[4], camera[5], camera[6]);
    if (!(std::abs(q.norm() - 1) < 1e-3)) {
      throw Error("--camera", "length of the quaternion", fmt::format("{}", q.norm()), "1");
    }
    return Eigen::Isometry3d(Eigen::Translation3d(camera[0], camera[1], camera[2]) * q.normalized());
  }
};

}  // namespace

void add_import(CLI::App& program) {
  CLI::App* import =
      program.add_subcommand("import", "Make trajectories and posture sets of what others recorded.");
  import->require_subcommand(1);
  CLI::App* command = import->add_subcommand("markers",
                                             "Fit the hand to captured markers or joint positions: joint angles "
                                             "and pose of every frame, as a trajectory for\n"
                                             "run and record, or as a posture set for db build. Residuals are "
                                             "written beside it (trajectories/README.md).");
  const auto state = std::make_shared<ImportMarkers>();
  command->add_option("file", state->files, "capture; several of --format handpose are one set")->required();
  command->add_option("--format", state->format, "csv, trc, webxr or handpose")->required();
  command->add_option("-o,--output", state->output, "file to write (*.json); its name is the trajectory's")
      ->required();
  command->add_option("--layout", state->layout, "JSON file that says where the markers of other names sit");
  command
      ->add_option("--postures", state->postures, "instead of the trajectory: that many postures that differ most")
      ->check(CLI::Range(1, 10000));
  command->add_option("--every", state->every, "of the trajectory, take every Nth frame")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      ->add_option("--camera", state->camera,
                   "the camera in the capture's frame: X Y Z (m) QW QX QY QZ [0.7 m above the back of the hand]")
      ->expected(7);
  command->add_flag("--left", state->left, "a left hand");
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
