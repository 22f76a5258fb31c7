#include "core/base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr size_t kLongest = 60;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  return lower;
}

/// Damerau-Levenshtein distance, in which no pair of characters is swapped and edited again.
size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<size_t>> edits(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const size_t replaced = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({replaced, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

bool is_part_of_path(std::string_view part) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
  return !part.empty() && part.front() != '.' && std::ranges::none_of(part, is_control);
}

/// For a name's first word, such as posture of posture_rms_deg. Null if there is none or several are equally short.
const std::string* shortest_that_begins_with(std::string_view word, const std::vector<std::string>& names) {
  constexpr size_t kFewest = 4;  // characters that say something
  if (word.size() < kFewest) return nullptr;
  const std::string* shortest = nullptr;
  size_t length = std::numeric_limits<size_t>::max();
  for (const std::string& name : names) {
    if (name.size() > length || !lower_case(name).starts_with(lower_case(word))) continue;
    shortest = name.size() < length ? &name : nullptr;
    length = name.size();
  }
  return shortest;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string line(text.substr(0, kLongest));
  std::ranges::replace_if(
      line, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > kLongest) line += "...";
  return line;
}

std::string quoted_excerpt(std::string_view text) {
  // Replaces invalid UTF-8: the text may hold any bytes, or be cut within a character.
  std::string quoted =
      nlohmann::json(text.substr(0, kLongest)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > kLongest) quoted += "...";
  return quoted;
}

std::string excerpt(const nlohmann::json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  if (value.is_string()) return quoted_excerpt(value.get_ref<const std::string&>());
  return value.dump();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string* nearest = nullptr;
  size_t fewest = word.size() + 1;
  for (const std::string& name : names) {
    const size_t longest = std::max(word.size(), name.size());
    if (longest - std::min(word.size(), name.size()) > longest / 3) continue;
    const size_t edits = edits_between(lower_case(word), lower_case(name));
    if (edits > longest / 3 || edits > fewest) continue;
    nearest = edits < fewest ? &name : nullptr;
    fewest = edits;
  }
  if (nearest == nullptr) nearest = shortest_that_begins_with(word, names);
  return nearest == nullptr ? "" : fmt::format("; did you mean {}?", *nearest);
}

std::string one_of(const std::vector<std::string>& names, std::string_view found) {
  return fmt::format("one of {}{}", fmt::join(names, ", "), did_you_mean(found, names));
}

bool is_name(std::string_view text) {
  constexpr size_t longest = 64;
  const auto is_alphanumeric = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (text.empty() || text.size() > longest || !is_alphanumeric(text.front())) return false;
  return std::ranges::all_of(
      text, [&](char c) { return is_alphanumeric(c) || c == '_' || c == '-' || c == '.' || c == ' '; });
}

std::string checked_name(std::string name, const std::string& where, const std::string& field) {
  if (!is_name(name)) throw Error(where, field, quoted_excerpt(name), kNameExpected);
  return name;
}

std::string path_within(const std::string& folder, std::string_view name) {
  for (size_t begin = 0; begin <= name.size();) {
    const size_t end = std::min(name.find('/', begin), name.size());
    if (!is_part_of_path(name.substr(begin, end - begin)))
      throw Error(folder, "file name", quoted_excerpt(name), "a name that stays in the folder");
    begin = end + 1;
  }
  return folder + "/" + std::string(name);
}

std::string place_within(const std::string& folder, std::string_view name) {
  const std::string path = path_within(folder, name);
  for (size_t end = name.find('/'); end != std::string_view::npos; end = name.find('/', end + 1)) {
    const std::string above = folder + "/" + std::string(name.substr(0, end));
    std::error_code ignored;  // a folder that cannot be looked at cannot be followed either
    if (std::filesystem::is_symlink(std::filesystem::symlink_status(above, ignored)))
      throw Error(above, "folder", "a link", "a folder, or nothing");
  }
  return path;
}

}  // namespace glovebench
