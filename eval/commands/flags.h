#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/robot/arm.h"
#include "core/tracker/tracker_config.h"
#include "eval/commands/options.h"
#include "eval/robot_commands.h"
#include "eval/workbench.h"

namespace glovebench::eval {

/// Flags that mean the same in every subcommand.
struct CommonFlags {
  std::string output;
  std::string config_file;
  nlohmann::json config_json;  ///< instead of a file: the configuration of an earlier run
  std::string profile = "paper";
  std::string method;  ///< empty: the configuration's
  std::string cascade;
  std::string calibration;          ///< file; empty: the synthetic Kinect's own
  nlohmann::json calibration_json;  ///< instead of a file: that of an earlier run
  std::string hand;                 ///< file; empty: the hand of the package's mesh
  nlohmann::json hand_json;         ///< instead of a file: that of an earlier run
  std::string cache_folder;
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all cores
  bool low_memory = false;
  bool left = false;
  bool quiet = false;

  Option add_output(Command command, const std::string& what);
  void add_tracker(Command command);
  void add_hand(Command command);
  void add_seed(Command command);
  /// The cameras of the synthetic Kinect.
  void add_cameras(Command command);
  void add_machine(Command command);

  /// Defaults < profile < file < command line. Throws Error.
  TrackerConfig tracker_config() const;
  Workbench workbench() const;
  /// Empty without `hand` and `hand_json`. Throws Error, also for a hand of the other side.
  std::optional<MeasuredHand> measured_hand() const;
  /// Counted up from `seed`. Throws Error if there are not so many.
  std::vector<uint64_t> seeds(int count) const;
  /// Throws Error if no file can be written to the output folder: before the work, not after it. Makes the folder.
  void check_output_folder() const;
};

/// How the hand is mounted on the arm.
struct MountingFlag {
  std::optional<Eigen::Isometry3d> transform;  ///< empty: default_T_flange_wrist()

  Option add(Command command);
  Eigen::Isometry3d T_flange_wrist() const;
};

/// What robot commands may do, and how J1 and J2 of its fingers hang together.
struct LimitsFlag {
  std::string file;  ///< JSON (`glovebench list limits`); empty: CommandLimits' own

  std::string coupling{to_string(CommandLimits().coupling)};

  void add(Command command);
  Option add_coupling(Command command);
  /// Throws Error.
  CommandLimits limits() const;
};

/// A file of the command line.
struct FileFlag {
  std::string flag;
  std::string path;  ///< empty: none
};
/// Throws Error if two of them are one file under whatever names, or one is where the lines of another are kept
/// until it is whole (core/base/line_file.h): one would replace the other. For all files that a command writes, and
/// those that it reads and could write.
void require_different_files(const std::vector<FileFlag>& files);

/// The arm's solver. Throws Error naming the field if this build has none.
std::unique_ptr<ArmSolver> require_arm_solver(const std::string& where, const std::string& field);

/// Where robot commands go, and how a hand becomes one.
struct RobotFlags {
  std::string output;
  std::string mapping = "direct";
  std::string arm = "auto";
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< empty: default_T_base_camera()
  MountingFlag mounting;
  LimitsFlag limits;

  /// Returns the option of `output`.
  Option add(Command command, const std::string& what);
  /// Of the workbench's hand. Throws Error if the arm is asked for and this program was built without it.
  RobotSetup setup(Workbench& workbench) const;
  RobotOutput output_of(Workbench& workbench) const;
};

}  // namespace glovebench::eval
