#include "core/adapters/process/tracker_answer.h"
#include "core/base/fuzz_target.h"

namespace glovebench {

void tracker_answer_fuzz(std::string_view bytes) {
  const TrackResult result = parse_answer(bytes, 0);
  if (result.status != TrackStatus::tracked) return;
  check(result.has.posture || result.has.pose || !result.joints.empty(), "a tracked frame has an estimate");
  check(result.posture_unfiltered.allFinite(), "angles are finite");
  const Eigen::Matrix3d R = result.T_camera_hand_unfiltered.linear();
  check((R * R.transpose()).isIdentity(1e-9) && R.determinant() > 0, "a pose is rigid");
  for (const auto& joint : result.joints) check(!joint || joint->allFinite(), "joints are finite");
}

}  // namespace glovebench
