#include "eval/robot_kinematics.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/robot/fingertip_mapping.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

void add_posture(MappingErrors& errors, const Fingertips& human, const Fingertips& robot) {
  ++errors.postures;
  for (int f = 0; f < 5; ++f) {
    const double error = (human.col(f) - robot.col(f)).norm();
    errors.tip_mean[f] += error;
    errors.tip_max[f] = std::max(errors.tip_max[f], error);
  }
  for (int f = 1; f < 5; ++f) {
    const double gap = (human.col(0) - human.col(f)).norm();
    if (gap >= kPinch) continue;
    const double error = std::abs((robot.col(0) - robot.col(f)).norm() - gap);
    ++errors.pinches;
    errors.gap_mean += error;
    errors.gap_max = std::max(errors.gap_max, error);
  }
}

std::string row(const std::string& name, const char* mapping, const MappingErrors& errors) {
  std::string text = fmt::format("{:<20} {:<9} {:>5}", name, mapping, errors.postures);
  for (int f = 0; f < 5; ++f)
    text += fmt::format(" {:>5.1f} {:>5.1f}", 1000 * errors.tip_mean[f], 1000 * errors.tip_max[f]);
  text += errors.pinches > 0 ? fmt::format(" {:>5} {:>5.1f} {:>5.1f}", errors.pinches, 1000 * errors.gap_mean,
                                           1000 * errors.gap_max)
                             : fmt::format(" {:>5} {:>5} {:>5}", 0, "-", "-");
  return text + fmt::format(" {:>5.1f}\n", degrees_from_radians(errors.largest_step));
}

std::string rows(const std::string& name, const Skeleton& skeleton, const std::vector<Posture>& postures,
                 ShadowCoupling coupling) {
  FingertipMapping fingertips(skeleton, coupling);
  const Mapping direct = [&](const Posture& posture) { return map_to_shadow_hand(posture, coupling); };
  return row(name, "direct", mapping_errors(skeleton, postures, direct)) +
         row(name, "fingertip",
             mapping_errors(skeleton, postures, [&](const Posture& posture) { return fingertips.map(posture); }));
}

}  // namespace

MappingErrors mapping_errors(const Skeleton& skeleton, const std::vector<Posture>& postures, const Mapping& map) {
  check(!postures.empty(), "a mapping is measured over postures");
  MappingErrors errors;
  std::array<double, kShadowJointCount> last{};
  for (const Posture& posture : postures) {
    const ShadowHandTargets targets = map(posture);
    add_posture(errors, human_fingertips(skeleton, posture), shadow_fingertips(targets.joints));
    for (int j = 0; errors.postures > 1 && j < kShadowJointCount; ++j)
      errors.largest_step = std::max(errors.largest_step, std::abs(targets.joints[j] - last[j]));
    last = targets.joints;
  }
  for (double& sum : errors.tip_mean) sum /= errors.postures;
  if (errors.pinches > 0) errors.gap_mean /= errors.pinches;
  return errors;
}

std::string mapping_table(const Skeleton& skeleton, const std::string& data_folder, ShadowCoupling coupling) {
  std::string table = fmt::format(
      "Fingertips of the robot against the hand's, mean and largest distance; gap: of fingertips that the hand has "
      "within\n"
      "{:.0f} mm of the thumb's, how much nearer or farther the robot's are. Step: the largest of a joint between "
      "frames.\nJ1 and J2 of the robot's fingers: {}.\n\n{:<36}{:>12}{:>12}{:>12}{:>12}{:>12}{:>18} step\n{:<20} "
      "{:<9} {:>5}",
      1000 * kPinch, to_string(coupling), "", "thumb mm", "index mm", "middle mm", "ring mm", "little mm", "gap mm",
      "", "mapping", "count");
  for (int f = 0; f < 5; ++f) table += "  mean   max";
  table += " pairs  mean   max   deg\n";
  for (const std::string& name : trajectories::posture_set_names())
    table += rows(name, skeleton, trajectories::posture_set(data_folder, name).postures, coupling);
  table += rows("gestures", skeleton, trajectories::load_gestures(data_folder).postures, coupling);
  for (const std::string& name : trajectories::script_names(data_folder)) {
    std::vector<Posture> postures;
    for (const auto& frame : trajectories::source_trajectory(data_folder, name).frames)
      postures.push_back(frame.posture);
    table += rows(name, skeleton, postures, coupling);
  }
  return table;
}

}  // namespace glovebench::eval
