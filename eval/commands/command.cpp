#include "eval/commands/command.h"

#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "core/base/whole_file.h"
#include "core/methods/method.h"
#ifdef GLOVEBENCH_ARM
#include "core/robot/arm/kdl_arm_solver.h"
#endif
#include "core/robot/command_limits.h"
#include "eval/share.h"
#include "reports/json_text.h"

namespace glovebench::eval {

constexpr uint64_t kLargestConfig = uint64_t{1} << 20;  // bytes

void CommonFlags::add_output(CLI::App& command, const std::string& what, bool required) {
  CLI::Option* option = command.add_option("-o,--output", output, what)->check(named_file());
  if (required) option->required();
}

void CommonFlags::add_tracker(CLI::App& command) {
  command.add_option("--profile", profile, "named configuration of the tracker")->capture_default_str();
  command.add_option("--config", config_file,
                     "JSON file with the fields to change; `glovebench list config` shows all");
  command.add_option("--method", method, "how to track (`glovebench list methods`) [the configuration's]");
  command.add_option("--cascade", cascade,
                     "matching cascade, SIZE:KEEP[,SIZE:KEEP...], e.g. 16:500,64:3, or exact:KEEP");
}

void CommonFlags::add_seed(CLI::App& command) {
  command.add_option("--seed", seed, "of all random numbers")->check(CLI::NonNegativeNumber)->capture_default_str();
}

void CommonFlags::add_cameras(CLI::App& command) {
  command.add_option(
      "--calibration", calibration,
      "cameras of the synthetic Kinect (*.json), as they are once their lenses are corrected [its own]");
}

void CommonFlags::add_machine(CLI::App& command) {
  command.add_option("--threads", threads, "0: all cores; results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--cache", cache_folder,
                     "folder for databases and color tables [GLOVEBENCH_CACHE or ~/.cache/glovebench]");
  command.add_flag("--low-memory", low_memory,
                   "databases that take a ninth of the memory and make their distance fields when these are asked "
                   "for; results do not depend on it");
  command.add_flag("-q,--quiet", quiet, "no progress, no messages");
}

TrackerConfig CommonFlags::tracker_config() const {
  TrackerConfig config = glovebench::profile(profile);
  if (!config_json.is_null()) config = config_from_json(config_json, config, "configuration of the run");
  if (!config_file.empty())
    config = config_from_json(parse_json(read_file(config_file, kLargestConfig), config_file), config, config_file);
  if (!method.empty()) config.method = find_method(method).name;
  if (!cascade.empty()) config.lookup.cascade = parse_cascade(cascade);
  return config;
}

Workbench CommonFlags::workbench() const {
  WorkbenchConfig config;
  config.cache_folder = cache_folder.empty() ? default_cache_folder() : cache_folder;
  config.side = left ? Side::left : Side::right;
  config.threads = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  config.memory = low_memory ? DatabaseMemory::low : DatabaseMemory::normal;
  config.quiet = quiet;
  config.views = tracker_config().views;
  if (!calibration_json.is_null())
    config.calibration = calibration_from_json(calibration_json, "calibration of the run");
  if (!calibration.empty()) config.calibration = load_calibration(calibration).rectified();
  return Workbench(config);
}

void MountingFlag::add(CLI::App& command) {
  command
      .add_option(
          "--flange-wrist", flange_wrist,
          "the hand's wrist (WRJ2) in the frame of the arm's flange: X Y Z (m) QW QX QY QZ [Shadow's forearm]")
      ->expected(7);
}

void LimitsFlag::add(CLI::App& command) {
  command.add_option(
      "--robot-limits", file,
      "JSON file with the limits of speed, space and time to change; `glovebench list limits` shows all");
}

void LimitsFlag::add_coupling(CLI::App& command) {
  command
      .add_option(
          "--robot-coupling", coupling,
          "how one motor moves J1 and J2 of a finger: series, J2 to 90 degrees and then J1; even, both alike")
      ->check(CLI::IsMember(shadow_coupling_names()))
      ->capture_default_str();
}

CommandLimits LimitsFlag::limits() const {
  CommandLimits limits;
  if (!file.empty()) limits = command_limits_from_json(parse_json(read_file(file, kLargestConfig), file), file);
  limits.coupling = shadow_coupling_from_string(coupling).value();
  return limits;
}

CLI::Option* RobotFlags::add(CLI::App& command, const std::string& what) {
  CLI::Option* const robot_out = command.add_option("--robot-out", output, what);
  command
      .add_option("--robot-mapping", mapping,
                  "to the robot's hand: direct, equal angles; fingertip, what is pinched stays pinched")
      ->check(CLI::IsMember({"direct", "fingertip"}))
      ->capture_default_str();
  command
      .add_option("--robot-arm", arm,
                  "joint angles of the arm: none; pa10, a PA-10-7C; auto, pa10 if it is built in")
      ->check(CLI::IsMember({"auto", "pa10", "none"}))
      ->capture_default_str();
  command
      .add_option("--base-camera", base_camera,
                  "the camera in the arm's base frame: X Y Z (m) QW QX QY QZ [above the work, looking down]")
      ->expected(7);
  mounting.add(command);
  limits.add_coupling(command);
  limits.add(command);
  return robot_out;
}

CLI::Validator named_file() {
  return {[](const std::string& text) -> std::string {
            return text == "-" ? "found -, expected the name of a file or folder" : "";
          },
          ""};
}

CLI::Validator number_within(double min, double max) {
  return {[=](const std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && value >= min && value <= max) return {};
            return fmt::format("found {}, expected a number from {} to {}", printable(text), min, max);
          },
          fmt::format("FLOAT in [{} - {}]", min, max)};
}

namespace {

Eigen::Isometry3d rigid_transform(const char* flag, const std::vector<double>& values) {
  for (const double value : values)
    if (!std::isfinite(value)) throw Error(flag, "transform", fmt::format("{}", value), "finite numbers");
  const Eigen::Quaterniond q(values[3], values[4], values[5], values[6]);
  if (!(std::abs(q.norm() - 1) < 1e-3)) {
    throw Error(flag, "length of the quaternion", fmt::format("{}", q.norm()), "1");
  }
  return Eigen::Translation3d(values[0], values[1], values[2]) * q.normalized();
}

/// As the flags take it, rounded.
nlohmann::json transform_json(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  nlohmann::json values = nlohmann::json::array();
  for (const double value :
       {T.translation().x(), T.translation().y(), T.translation().z(), q.w(), q.x(), q.y(), q.z()})
    values.push_back(reports::rounded(value));
  return values;
}

/// The arm that was built in, if one was. Throws Error if it is required and was not.
std::shared_ptr<const ArmSolver> arm_solver([[maybe_unused]] bool required) {
#ifdef GLOVEBENCH_ARM
  return make_kdl_arm_solver();
#else
  if (required)
    throw Error("--robot-arm", "pa10", "a program built without Orocos KDL",
                "one configured with it (Debian: liborocos-kdl-dev)");
  return nullptr;
#endif
}

}  // namespace

Eigen::Isometry3d MountingFlag::T_flange_wrist() const {
  return flange_wrist.empty() ? default_T_flange_wrist() : rigid_transform("--flange-wrist", flange_wrist);
}

RobotSetup RobotFlags::setup(Workbench& workbench) const {
  RobotSetup setup;
  if (!base_camera.empty()) setup.T_base_camera = rigid_transform("--base-camera", base_camera);
  setup.T_flange_wrist = mounting.T_flange_wrist();
  if (arm != "none") setup.arm = arm_solver(arm == "pa10");
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

void CommonFlags::check_output_folder() const {
  if (std::filesystem::exists(output + "/provenance.json"))
    throw Error("--output", "folder", output + ", which holds a baseline", "another: both have a results.json");
  const WholeFile probe(output + "/results.json");  // never committed: nothing stays
}

}  // namespace glovebench::eval
