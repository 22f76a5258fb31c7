#include "core/database/cascade.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/error.h"
#include "core/database/tiny_image.h"

namespace glovebench {
namespace {

constexpr int kMaxKeep = 100'000'000;
constexpr std::string_view kExact = "exact:";

int parse_number(std::string_view text, std::string_view whole) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error("cascade", "\"" + std::string(whole) + "\"", "\"" + std::string(text) + "\"",
                "SIZE:KEEP[,SIZE:KEEP...] such as 16:500,64:3, or exact:KEEP");
  }
  return value;
}

void check_stage(const CascadeStage& stage, const Cascade& before) {
  const std::string name = fmt::format("stage {}:{}", stage.size, stage.keep);
  if (std::find(kTinySizes.begin(), kTinySizes.end(), stage.size) == kTinySizes.end()) {
    throw Error("cascade", name, fmt::format("size {}", stage.size), "8, 16, 32 or 64");
  }
  if (stage.keep < 1 || stage.keep > kMaxKeep) {
    throw Error("cascade", name, fmt::format("keep {}", stage.keep),
                fmt::format("at least 1 and at most {}", kMaxKeep));
  }
  if (!before.empty() && stage.keep > before.back().keep) {
    throw Error("cascade", name, fmt::format("keep {}", stage.keep),
                fmt::format("at most the {} of the stage before it", before.back().keep));
  }
}

}  // namespace

Cascade parse_cascade(std::string_view text) {
  if (text.starts_with(kExact)) {
    const CascadeStage stage{kTinySizes.back(), parse_number(text.substr(kExact.size()), text)};
    check_stage(stage, {});
    return {stage};
  }
  Cascade cascade;
  std::string_view rest = text;
  while (true) {
    const std::string_view stage = rest.substr(0, rest.find(','));
    const size_t colon = stage.find(':');
    if (colon == std::string_view::npos) parse_number("", text);
    const CascadeStage parsed{parse_number(stage.substr(0, colon), text),
                              parse_number(stage.substr(colon + 1), text)};
    check_stage(parsed, cascade);
    cascade.push_back(parsed);
    if (stage.size() == rest.size()) return cascade;
    rest.remove_prefix(stage.size() + 1);
  }
}

std::string to_string(const Cascade& cascade) {
  std::string text;
  for (const CascadeStage& stage : cascade) {
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", stage.size, stage.keep);
  }
  return text;
}

}  // namespace glovebench
