#include "reports/commands.h"

namespace glovebench::reports {

const std::array<CommandErrorInfo, 4>& command_error_infos() {
  static const std::array<CommandErrorInfo, 4> infos = {
      {{"joints_deg", "joints deg", &CommandErrors::joints_deg},
       {"position_mm", "position mm", &CommandErrors::position_mm},
       {"rotation_deg", "rotation deg", &CommandErrors::rotation_deg},
       {"arm_deg", "arm deg", &CommandErrors::arm_deg}}};
  return infos;
}

}  // namespace glovebench::reports
