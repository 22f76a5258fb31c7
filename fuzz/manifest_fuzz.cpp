#include "core/base/file_set.h"
#include "core/base/name.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const Manifest manifest = parse_manifest(std::string(fuzz::as_text(data, size)), "manifest.json");
    for (const auto& [name, entry] : manifest) path_within("folder", name);  // none leads out of it
    const std::string text = manifest_json(manifest);
    check(manifest_json(parse_manifest(text, "manifest.json")) == text, "a manifest returns as it was");
  });
}
