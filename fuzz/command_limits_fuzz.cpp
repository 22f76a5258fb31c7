#include <nlohmann/json.hpp>

#include "core/base/parse_json.h"
#include "core/robot/command_limits.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const nlohmann::json json = parse_json(fuzz::as_text(data, size), "limits.json");
    const CommandLimits limits = command_limits_from_json(json, "limits.json");
    check(limits.problems().empty(), "limits that were read have no problems");
    const nlohmann::json written = to_json(limits);
    check(to_json(command_limits_from_json(written, "again")) == written, "limits return");
  });
}
