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

reports::Row row(const std::string& name, const char* mapping, const MappingErrors& errors) {
  reports::Row row = {name, mapping, int64_t{errors.postures}};
  for (int f = 0; f < 5; ++f) {
    row.emplace_back(1000 * errors.tip_mean[f]);
    row.emplace_back(1000 * errors.tip_max[f]);
  }
  const auto of_pinches = [&](double gap) {
    return errors.pinches > 0 ? reports::Cell(1000 * gap) : reports::Cell();
  };
  row.insert(row.end(), {int64_t{errors.pinches}, of_pinches(errors.gap_mean), of_pinches(errors.gap_max),
                         degrees_from_radians(errors.largest_step)});
  return row;
}

void add_rows(reports::Table& table, const std::string& name, const Skeleton& skeleton,
              const std::vector<Posture>& postures, ShadowCoupling coupling) {
  FingertipMapping fingertips(skeleton, coupling);
  const Mapping direct = [&](const Posture& posture) { return map_to_shadow_hand(posture, coupling); };
  const Mapping mapped = [&](const Posture& posture) { return fingertips.map(posture); };
  table.rows.push_back(row(name, "direct", mapping_errors(skeleton, postures, direct)));
  table.rows.push_back(row(name, "fingertip", mapping_errors(skeleton, postures, mapped)));
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

reports::Table mapping_table(const Skeleton& skeleton, const std::string& data_folder, ShadowCoupling coupling) {
  reports::Table table = reports::table_of({"postures of", "mapping"}, 2);
  table.explanation = fmt::format(
      "Fingertips of the robot against the hand's: mean and largest distance in mm. Of pairs that the hand has "
      "within {:.0f} mm (thumb and another): how much nearer or farther apart the robot's are, in mm. Step: the "
      "largest of a joint between frames. J1 and J2 of the robot's fingers: {}.",
      1000 * kPinch, to_string(coupling));
  const auto add_column = [&](const std::string& heading, int digits) {
    table.columns.push_back({"", heading, digits});
  };
  add_column("count", 0);
  for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
    add_column(finger, 1);
    add_column(fmt::format("{} max", finger), 1);
  }
  add_column("pairs", 0);
  add_column("gap", 1);
  add_column("gap max", 1);
  add_column("step deg", 1);
  for (const std::string& name : trajectories::posture_set_names())
    add_rows(table, name, skeleton, trajectories::posture_set(data_folder, name).postures, coupling);
  add_rows(table, "gestures", skeleton, trajectories::load_gestures(data_folder).postures, coupling);
  for (const std::string& name : trajectories::script_names(data_folder)) {
    std::vector<Posture> postures;
    for (const auto& frame : trajectories::source_trajectory(data_folder, name).frames)
      postures.push_back(frame.posture);
    add_rows(table, name, skeleton, postures, coupling);
  }
  return table;
}

}  // namespace glovebench::eval
