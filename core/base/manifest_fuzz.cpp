#include "core/base/file_set.h"
#include "core/base/fuzz_target.h"
#include "core/base/text.h"

namespace glovebench {

void manifest_fuzz(std::string_view bytes) {
  const Manifest manifest = parse_manifest(std::string(bytes), "manifest.json");
  for (const auto& [name, entry] : manifest) path_within("folder", name);  // none leads out of it
  const std::string text = manifest_json(manifest);
  check(manifest_json(parse_manifest(text, "manifest.json")) == text, "a manifest returns as it was");
}

}  // namespace glovebench
