#include "eval/commands/flags.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "core/adapters/kdl/make_arm_solver.h"
#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "core/base/whole_file.h"
#include "core/hand/hand_file.h"
#include "core/methods/method.h"
#include "core/robot/command_limits.h"
#include "eval/estimates/estimate_format.h"
#include "eval/program.h"
#include "eval/terminal.h"
#include "reports/text.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {

constexpr uint64_t kLargestConfig = uint64_t{1} << 20;  // bytes

Option CommonFlags::add_output(Command command, const std::string& what) {
  return command.option("-o,--output", output, what).named_file();
}

void CommonFlags::add_hand(Command command) {
  command.option(
      "--hand", hand,
      "the person's hand (*.json, `glovebench calibrate hand`); databases are built of it [the package's]");
}

void CommonFlags::add_seed(Command command) {
  command.option("--seed", seed, "of all random numbers").not_negative();
}

void CommonFlags::add_cameras(Command command) {
  command
      .option("--calibration", calibration,
              "cameras of the synthetic Kinect (*.json), as they are once their lenses are corrected [its own]")
      .rare();
}

void CommonFlags::add_machine(Command command) {
  command = command.group("Machine");
  command.option("--threads", threads, "0: all cores; results do not depend on it").in(0, 1024);
  command
      .option("--cache", cache_folder,
              "folder for databases and color tables [GLOVEBENCH_CACHE or ~/.cache/glovebench]")
      .rare();
  command
      .option("--low-memory", low_memory,
              "databases that take a ninth of the memory and make their distance fields when these are asked for; "
              "results do not depend on it")
      .rare();
  command.option("-q,--quiet", quiet, "print only errors, warnings, and results that go to no file");
}

TrackerConfig CommonFlags::tracker_config() const {
  TrackerConfig config = glovebench::profile(profile);
  if (!config_json.is_null()) config = config_from_json(config_json, config, "configuration of the run");
  if (!config_file.empty())
    config = config_from_json(parse_json(read_file(config_file, kLargestConfig), config_file), config, config_file);
  if (!method.empty()) config.method = is_program(method) ? method : find_method(method).name;
  if (!cascade.empty()) config.lookup.cascade = parse_cascade(cascade);
  return config;
}

Workbench CommonFlags::workbench() const {
  WorkbenchConfig config;
  config.cache_folder = cache_folder.empty() ? default_cache_folder() : cache_folder;
  config.side = left ? Side::left : Side::right;
  config.hand = measured_hand();
  config.threads = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  config.memory = low_memory ? DatabaseMemory::low : DatabaseMemory::normal;
  config.quiet = quiet;
  config.views = tracker_config().views;
  if (!calibration_json.is_null())
    config.calibration = calibration_from_json(calibration_json, "calibration of the run");
  if (!calibration.empty()) config.calibration = load_calibration(calibration).rectified();
  return Workbench(config);
}

void CommonFlags::warn_of_units(const trajectories::Trajectory& trajectory) const {
  for (const std::string& doubt : trajectories::unit_doubts(trajectory, tracker_config().volume))
    say("glovebench: warning: {}: {}\n", trajectory.name, doubt);
}

std::optional<MeasuredHand> CommonFlags::measured_hand() const {
  if (!hand_json.is_null()) return hand_from_json(hand_json, "hand of the run");
  if (hand.empty()) return {};
  const MeasuredHand measured = load_hand(hand);
  const Side side = left ? Side::left : Side::right;
  if (measured.side != side)
    throw Error(hand, "side", std::string(to_string(measured.side)),
                fmt::format("{}, the side of the hand that is tracked", to_string(side)));
  return measured;
}

std::vector<uint64_t> CommonFlags::seeds(int count) const {
  const uint64_t largest = std::numeric_limits<uint64_t>::max() - static_cast<uint64_t>(count - 1);
  if (seed > largest) throw Error("--seed", "value", fmt::format("{}", seed), fmt::format("at most {}", largest));
  std::vector<uint64_t> seeds;
  for (int s = 0; s < count; ++s) seeds.push_back(seed + static_cast<uint64_t>(s));
  return seeds;
}

Option MountingFlag::add(Command command) {
  return command.option(
      "--flange-wrist", transform,
      "the hand's wrist (WRJ2) in the frame of the arm's flange: X Y Z (m) QW QX QY QZ [Shadow's forearm]");
}

Option LimitsFlag::add(Command command) {
  return command.option(
      "--robot-limits", file,
      "JSON file with the limits of speed, space and time to change; `glovebench list limits` shows all");
}

Option LimitsFlag::add_coupling(Command command) {
  return command
      .option("--robot-coupling", coupling,
              "how one motor moves J1 and J2 of a finger: series, J2 to 90 degrees and then J1; even, both alike")
      .one_of(all_names<ShadowCoupling>());
}

CommandLimits LimitsFlag::limits() const {
  CommandLimits limits;
  if (!file.empty()) limits = command_limits_from_json(parse_json(read_file(file, kLargestConfig), file), file);
  limits.coupling = from_name<ShadowCoupling>(coupling).value();
  return limits;
}

Option RobotFlags::add(Command command, const std::string& what) {
  command = command.group("Robot");
  const Option robot_out = command.option("--robot-out", output, what);
  command
      .option("--robot-mapping", mapping,
              "to the robot's hand: direct, equal angles; fingertip, what is pinched stays pinched")
      .one_of({"direct", "fingertip"});
  command
      .option("--robot-arm", arm, "joint angles of the arm: none; pa10, a PA-10-7C; auto, pa10 if it is built in")
      .one_of({"auto", "pa10", "none"});
  command
      .option("--base-camera", T_base_camera,
              "the camera in the arm's base frame: X Y Z (m) QW QX QY QZ [above the work, looking down]")
      .rare();
  mounting.add(command).rare();
  limits.add_coupling(command).rare();
  limits.add(command).rare();
  return robot_out;
}

namespace {

/// Rounded, as the flags take it.
nlohmann::json transform_json(const Eigen::Isometry3d& T) {
  nlohmann::json values = nlohmann::json::array();
  for (const double value : pose_numbers(T)) values.push_back(reports::rounded(value));
  return values;
}

}  // namespace

std::unique_ptr<ArmSolver> require_arm_solver(const std::string& where, const std::string& field) {
  std::unique_ptr<ArmSolver> solver = make_arm_solver();
  if (!solver)
    throw Error(where, field, "a glovebench that was built without Orocos KDL",
                "one that was configured with it (Debian: liborocos-kdl-dev)");
  return solver;
}

Eigen::Isometry3d MountingFlag::T_flange_wrist() const { return transform.value_or(default_T_flange_wrist()); }

RobotSetup RobotFlags::setup(Workbench& workbench) const {
  RobotSetup setup;
  setup.T_base_camera = T_base_camera.value_or(setup.T_base_camera);
  setup.T_flange_wrist = mounting.T_flange_wrist();
  if (arm == "pa10") setup.arm = require_arm_solver("--robot-arm", arm);
  if (arm == "auto") setup.arm = make_arm_solver();
  setup.coupling = limits.limits().coupling;
  if (mapping == "fingertip") setup.skeleton = workbench.model()->skeleton();
  return setup;
}

RobotOutput RobotFlags::output_of(Workbench& workbench) const {
  RobotOutput robot{output, setup(workbench), limits.limits()};
  robot.configuration = {{"mapping", mapping},
                         {"coupling", std::string(to_string(robot.limits.coupling))},
                         {"arm", robot.setup.arm ? "pa10" : "none"},
                         {"base_camera", transform_json(robot.setup.T_base_camera)},
                         {"flange_wrist", transform_json(robot.setup.T_flange_wrist)},
                         {"limits", to_json(robot.limits)}};
  return robot;
}

namespace {

/// Equal for all names of a file, even if it does not exist yet.
std::string identity(const std::string& path) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(path, ignored);  // its reader or writer reports it
  const OutputTarget target = is_folder ? OutputTarget{.path = path} : find_output(path);
  if (target.is_stream) {
    struct stat found = {};
    const bool is_open = target.descriptor >= 0;
    if ((is_open ? ::fstat(target.descriptor, &found) : ::stat(path.c_str(), &found)) == 0)
      return fmt::format("device {}, inode {}", found.st_dev, found.st_ino);
  }
  std::error_code error;
  const std::filesystem::path found =
      std::filesystem::weakly_canonical(std::filesystem::absolute(target.path), error);
  return error ? target.path : found.string();
}

}  // namespace

void refuse_twice(const std::string& flag, const std::vector<std::string>& names) {
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    throw Error(flag, "names", "one of them twice", "each once");
}

void require_different_files(const std::vector<FileFlag>& files) {
  std::map<std::string, std::string> flags;  // by identity
  for (const FileFlag& file : files) {
    if (file.path.empty()) continue;
    const std::string own = identity(file.path);
    for (const auto& [other, flag] : flags)
      if (own == other || own.starts_with(other + ".partial") || other.starts_with(own + ".partial"))
        throw Error(file.flag, "file", file.path, "another than that of " + flag);
    flags[own] = file.flag;
  }
}

void require_writable_files(const std::vector<FileFlag>& files) {
  for (const FileFlag& file : files)
    if (!file.path.empty() && !file.path.ends_with(file.ending))
      throw Error(file.flag, "file name", file.path, "the ending " + file.ending);
  require_different_files(files);
  for (const FileFlag& file : files)
    if (!file.path.empty()) const WholeFile probe(file.path);  // never committed: nothing stays
}

void CommonFlags::check_output_folder() const {
  if (std::filesystem::exists(output + "/provenance.json"))
    throw Error("--output", "folder", output + ", which holds a baseline", "another: both have a results.json");
  const WholeFile probe(output + "/results.json");  // tests that files can be written; never committed
}

void CommonFlags::check_report_folder() const {
  check_output_folder();
  require_own_files(output, {"results.json", "config.json", "index.html", "summary.md"});
}

}  // namespace glovebench::eval
