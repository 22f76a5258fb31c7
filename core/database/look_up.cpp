#include "core/database/look_up.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kMaxKeep = 100'000'000;

/// Where a query reads in the fields of an entry: one offset a glove pixel.
std::vector<int> glove_offsets(const LabelImage& query) {
  std::vector<int> offsets;
  const int pixels = static_cast<int>(query.size());
  for (int i = 0; i < pixels; ++i) {
    if (query[i] != 0) offsets.push_back((query[i] - 1) * pixels + i);
  }
  return offsets;
}

/// Sum of the stored distances, in steps of 1/kFieldScale px; at most 4096 * 255.
uint32_t stored_sum(const uint8_t* fields, const std::vector<int>& offsets) {
  uint32_t sum = 0;
  for (const int offset : offsets) sum += fields[offset];
  return sum;
}

float pixels_from_sum(uint32_t sum, size_t count) {
  return static_cast<float>(sum) / static_cast<float>(kFieldScale * count);
}

int parse_number(std::string_view text, std::string_view whole) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error("cascade", "\"" + std::string(whole) + "\"", "\"" + std::string(text) + "\"",
                "SIZE:KEEP[,SIZE:KEEP...] such as 16:500,64:3");
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

TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade) {
  TinyImages query;
  for (const CascadeStage& stage : cascade) {
    query.images.push_back(make_tiny_image(labels, square, stage.size));
  }
  return query;
}

float distance(const Database& database, int entry, const LabelImage& query) {
  const std::vector<int> offsets = glove_offsets(query);
  if (offsets.empty()) return 0;
  return pixels_from_sum(stored_sum(database.fields(query.width(), entry), offsets), offsets.size());
}

std::vector<float> distances(const Database& database, const LabelImage& query) {
  const std::vector<int> offsets = glove_offsets(query);
  std::vector<float> result(database.entry_count(), 0.0f);
  if (offsets.empty()) return result;
  for (int entry = 0; entry < database.entry_count(); ++entry) {
    result[entry] = pixels_from_sum(stored_sum(database.fields(query.width(), entry), offsets), offsets.size());
  }
  return result;
}

std::vector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                           LookUpTrace* trace) {
  if (trace != nullptr) trace->kept.clear();
  struct Candidate {
    uint32_t sum;
    int entry;
    bool operator<(const Candidate& other) const {
      return sum != other.sum ? sum < other.sum : entry < other.entry;
    }
  };
  std::vector<Candidate> candidates(database.entry_count());
  for (int entry = 0; entry < database.entry_count(); ++entry) candidates[entry] = {0, entry};

  std::vector<int> offsets;
  for (size_t s = 0; s < cascade.size(); ++s) {
    offsets = glove_offsets(query.images[s]);
    if (offsets.empty()) return {};
    for (Candidate& candidate : candidates) {
      candidate.sum = stored_sum(database.fields(cascade[s].size, candidate.entry), offsets);
    }
    const size_t keep = std::min<size_t>(cascade[s].keep, candidates.size());
    std::partial_sort(candidates.begin(), candidates.begin() + keep, candidates.end());
    candidates.resize(keep);
    if (trace == nullptr) continue;
    std::vector<int>& kept = trace->kept.emplace_back();
    for (const Candidate& candidate : candidates) kept.push_back(candidate.entry);
  }
  std::vector<Match> matches;
  for (const Candidate& candidate : candidates) {
    matches.push_back({candidate.entry, pixels_from_sum(candidate.sum, offsets.size())});
  }
  return matches;
}

std::span<const LookUpImplementation> look_up_implementations() {
  static constexpr std::array<LookUpImplementation, 1> implementations = {{{"plain", look_up}}};
  return implementations;
}

}  // namespace glovebench
