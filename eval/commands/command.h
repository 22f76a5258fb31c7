#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "core/tracker/tracker_config.h"
#include "eval/experiments.h"
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
  std::string cache_folder;
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all cores
  bool low_memory = false;
  bool left = false;
  bool quiet = false;

  void add_output(CLI::App& command, const std::string& what, bool required = false);
  void add_tracker(CLI::App& command);
  void add_seed(CLI::App& command);
  /// The cameras of the synthetic Kinect.
  void add_cameras(CLI::App& command);
  void add_machine(CLI::App& command);

  /// Defaults < profile < file < command line. Throws Error.
  TrackerConfig tracker_config() const;
  Workbench workbench() const;
  /// Throws Error if no file can be written to the output folder: before the work, not after it. Makes the folder.
  void check_output_folder() const;
};

/// Checks an option: the name of a file or folder, not `-`. For commands that print something else to standard
/// output.
CLI::Validator named_file();

/// Checks an option: a number from `min` to `max`. CLI::Range lets pass what is no number.
CLI::Validator number_within(double min, double max);

/// How the hand is mounted on the arm.
struct MountingFlag {
  std::vector<double> flange_wrist;  ///< x, y, z (m), quaternion w, x, y, z; empty: default_T_flange_wrist()

  void add(CLI::App& command);
  /// Throws Error unless all is finite and the quaternion has unit length.
  Eigen::Isometry3d T_flange_wrist() const;
};

/// What robot commands may do, and how J1 and J2 of its fingers hang together.
struct LimitsFlag {
  std::string file;  ///< JSON (`glovebench list limits`); empty: CommandLimits' own

  std::string coupling{to_string(CommandLimits().coupling)};

  void add(CLI::App& command);
  void add_coupling(CLI::App& command);
  /// Throws Error.
  CommandLimits limits() const;
};

/// Where robot commands go, and how a hand becomes one.
struct RobotFlags {
  std::string output;
  std::string mapping = "direct";
  std::string arm = "auto";
  std::vector<double> base_camera;  ///< x, y, z (m), quaternion w, x, y, z; empty: default_T_base_camera()
  MountingFlag mounting;
  LimitsFlag limits;

  /// Returns the option of `output`.
  CLI::Option* add(CLI::App& command, const std::string& what);
  /// Of the workbench's hand. Throws Error unless transforms are finite and their quaternions have unit length, or
  /// if the arm is asked for and this program was built without it.
  RobotSetup setup(Workbench& workbench) const;
  RobotOutput output_of(Workbench& workbench) const;
};

/// Each adds one subcommand to the program.
/// Sets the exit code when it has run.
void add_reproduce(CLI::App& program, int& exit_code);
void add_run(CLI::App& program);
void add_record(CLI::App& program);
void add_render(CLI::App& program);
void add_track(CLI::App& program);
/// Sets the exit code when it has run.
void add_robot_server(CLI::App& program, int& exit_code);
void add_explain(CLI::App& program);
void add_db(CLI::App& program);
void add_import(CLI::App& program);
void add_list(CLI::App& program);
void add_compare(CLI::App& program);
/// Sets the exit code when it has run.
void add_gate(CLI::App& program, int& exit_code);
void add_calibrate(CLI::App& program);

}  // namespace glovebench::eval
