#include "core/database/look_up.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/registry.h"
#include "core/base/text.h"
#include "core/database/look_up_parts.h"
#include "core/database/tiny_image.h"

namespace glovebench {
namespace {

constexpr int kMaxKeep = 100'000'000;
constexpr std::string_view kExact = "exact:";

int parse_number(std::string_view text, std::string_view whole) {
  if (const std::optional<int> value = number_in<int>(text)) return *value;
  throw Error("cascade", "\"" + std::string(whole) + "\"", "\"" + std::string(text) + "\"",
              "SIZE:KEEP[,SIZE:KEEP...] such as 16:500,64:3, or exact:KEEP");
}

void check_stage(const CascadeStage& stage, const Cascade& before) {
  const std::string name = fmt::format("stage {}:{}", stage.size, stage.keep);
  if (std::find(kTinySizes.begin(), kTinySizes.end(), stage.size) == kTinySizes.end())
    throw Error("cascade", name, fmt::format("size {}", stage.size), "8, 16, 32 or 64");
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

TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade) {
  TinyImages query;
  for (const CascadeStage& stage : cascade) query.images.push_back(make_tiny_image(labels, square, stage.size));
  return query;
}

float distance(const Database& database, int entry, const LabelImage& query) {
  const RecycledVector<int> offsets = glove_offsets(query);
  if (offsets.empty()) return 0;
  return pixels_from_sum(sum_of(EntryFields(database, query).of(entry), offsets), offsets.size());
}

std::vector<float> distances(const Database& database, const LabelImage& query) {
  const RecycledVector<int> offsets = glove_offsets(query);
  std::vector<float> result(database.entry_count(), 0.0f);
  if (offsets.empty()) return result;
  EntryFields fields(database, query);
  for (int entry = 0; entry < database.entry_count(); ++entry)
    result[entry] = pixels_from_sum(sum_of(fields.of(entry), offsets), offsets.size());
  return result;
}

RecycledVector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                              std::string_view name, LookUpTrace* trace) {
  const LookUpEntry& entry = find_in(look_ups(), name, "look-up", "name");
  database.require_unchanged();
  if (trace != nullptr) trace->kept.clear();
  return entry.look_up(database, query, cascade, trace);
}

Cascade parse_cascade(std::string_view text) {
  if (text.starts_with(kExact)) {
    const CascadeStage stage{kTinySizes.back(), parse_number(text.substr(kExact.size()), text)};
    check_stage(stage, {});
    return {stage};
  }
  Cascade cascade;
  for (const std::string_view stage : split(text, ',')) {
    const size_t colon = stage.find(':');
    if (colon == std::string_view::npos) parse_number("", text);
    const CascadeStage parsed{parse_number(stage.substr(0, colon), text),
                              parse_number(stage.substr(colon + 1), text)};
    check_stage(parsed, cascade);
    cascade.push_back(parsed);
  }
  return cascade;
}

std::string to_string(const Cascade& cascade) {
  std::string text;
  for (const CascadeStage& stage : cascade)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", stage.size, stage.keep);
  return text;
}

}  // namespace glovebench
