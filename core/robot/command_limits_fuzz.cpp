#include <nlohmann/json.hpp>

#include "core/base/fuzz_target.h"
#include "core/base/parse_json.h"
#include "core/robot/command_limits.h"

namespace glovebench {

void command_limits_fuzz(std::string_view bytes) {
  const nlohmann::json json = parse_json(bytes, "limits.json");
  const CommandLimits limits = command_limits_from_json(json, "limits.json");
  check(limits.problems().empty(), "limits that were read have no problems");
  const nlohmann::json written = to_json(limits);
  check(to_json(command_limits_from_json(written, "again")) == written, "limits return");
}

}  // namespace glovebench
