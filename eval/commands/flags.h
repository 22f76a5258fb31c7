#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/robot/arm.h"
#include "core/tracker/tracker_config.h"
#include "eval/command_measurement.h"
#include "eval/commands/options.h"
#include "eval/workbench.h"
#include "reports/comparison/comparison.h"

namespace glovebench::eval {

struct CommonFlags {
  std::string output;
  std::string config_file;
  nlohmann::json config_json;  ///< of an earlier run
  std::string profile = "paper";
  std::string method;  ///< empty: the configuration's
  std::string cascade;
  std::string calibration;  ///< file; empty: the synthetic Kinect's
  nlohmann::json calibration_json;
  std::string hand;  ///< file; empty: the package's mesh
  nlohmann::json hand_json;
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
  void add_cameras(Command command);
  void add_machine(Command command);

  /// Defaults < profile < file < command line.
  /// Throws: Error.
  TrackerConfig tracker_config() const;
  Workbench workbench() const;
  /// Empty without `hand` and `hand_json`.
  /// Throws: Error, also for a hand of the other side.
  std::optional<MeasuredHand> measured_hand() const;
  /// Warns on stderr of likely mistakes in units.
  void warn_of_units(const trajectories::Trajectory& trajectory) const;
  /// `count` seeds from `seed` on.
  /// Throws: Error beyond the largest seed.
  std::vector<uint64_t> seeds(int count) const;
  /// Makes the folder.
  /// Throws: Error.
  void check_output_folder() const;
  /// Throws: Error as `check_output_folder`, or if the report would replace a file that no run wrote.
  void check_report_folder() const;
};

struct NamedTracker {
  std::string name;
  TrackerConfig tracker;
};

/// Flags of a command that compares trackers, one of which may be repeated.
struct TrackerChoices {
  std::vector<std::string> profiles, configs, methods, cascades;

  void add(Command command);
  /// Sets the flags of `common` to the first values.
  /// Throws: Error if two flags have several values.
  void choose(CommonFlags& common) const;
  bool are_several() const;
  /// One configuration per value of the repeated flag; the first is the paper's if none of them is.
  /// Throws: Error for a bad value, equal names, or different database views.
  std::vector<NamedTracker> trackers(const CommonFlags& common) const;
};

struct ComparisonFlags {
  std::vector<std::string> metrics;  ///< empty: the command's default
  double confidence = 0.99;

  void add(Command command, const std::string& default_metrics);
  /// Throws: Error for a repeated metric.
  reports::CompareConfig config() const;
};

struct MountingFlag {
  std::optional<Eigen::Isometry3d> transform;  ///< empty: default_T_flange_wrist()

  Option add(Command command);
  Eigen::Isometry3d T_flange_wrist() const;
};

struct LimitsFlag {
  std::string file;  ///< like `glovebench list limits`; empty: defaults

  std::string coupling{to_string(CommandLimits().coupling)};

  Option add(Command command);
  Option add_coupling(Command command);
  /// Throws: Error.
  CommandLimits limits() const;
};

struct FileFlag {
  std::string flag;
  std::string path;         ///< empty: none
  std::string ending = {};  ///< required; empty: any
};
/// Throws: Error if a name repeats.
void refuse_twice(const std::string& flag, const std::vector<std::string>& names);

/// Throws: Error if two are one file, or one is another's partial file (core/base/line_file.h).
void require_different_files(const std::vector<FileFlag>& files);
/// Throws: Error as `require_different_files`, for another ending, or if one cannot be written.
void require_writable_files(const std::vector<FileFlag>& files);

/// Throws: Error in a build without a solver.
std::unique_ptr<ArmSolver> require_arm_solver(const std::string& where, const std::string& field);

struct RobotFlags {
  std::string output;
  std::string mapping = "direct";
  std::string arm = "auto";
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< empty: default_T_base_camera()
  MountingFlag mounting;
  LimitsFlag limits;

  /// Returns the option of `output`.
  Option add(Command command, const std::string& what);
  /// Throws: Error as `require_arm_solver`.
  RobotSetup setup(Workbench& workbench) const;
  RobotOutput output_of(Workbench& workbench) const;
};

}  // namespace glovebench::eval
