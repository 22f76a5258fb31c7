#include <nlohmann/json.hpp>

#include "core/base/fuzz_target.h"
#include "core/base/parse_json.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

void configuration_fuzz(std::string_view bytes) {
  const nlohmann::json json = parse_json(bytes, "config.json");
  const nlohmann::json written = to_json(config_from_json(json, {}, "config.json"));
  check(to_json(config_from_json(written, {}, "again")) == written, "a configuration returns");
}

}  // namespace glovebench
