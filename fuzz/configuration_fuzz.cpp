#include <nlohmann/json.hpp>

#include "core/base/parse_json.h"
#include "core/tracker/tracker_config.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const nlohmann::json json = parse_json(fuzz::as_text(data, size), "config.json");
    const nlohmann::json written = to_json(config_from_json(json, {}, "config.json"));
    check(to_json(config_from_json(written, {}, "again")) == written, "a configuration returns");
  });
}
