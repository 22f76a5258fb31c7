#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/commands/flags.h"
#include "reports/metrics/metric.h"

namespace glovebench::eval {
namespace {

using Values = std::vector<std::string>;

/// A flag of the tracker, where its values are and where one of them goes.
struct TrackerFlag {
  const char* name;
  const char* help;
  Values TrackerChoices::*values;
  std::string CommonFlags::*value;
};
constexpr std::array<TrackerFlag, 4> kTrackerFlags = {{
    {"--profile", "named configuration of the tracker", &TrackerChoices::profiles, &CommonFlags::profile},
    {"--config", "JSON file with the fields to change; `glovebench list config` shows all",
     &TrackerChoices::configs, &CommonFlags::config_file},
    {"--method",
     "how to track (`glovebench list methods`), or exec:COMMAND, a program of yours [the configuration's]",
     &TrackerChoices::methods, &CommonFlags::method},
    {"--cascade", "matching cascade, SIZE:KEEP[,SIZE:KEEP...], e.g. 16:500,64:3, or exact:KEEP",
     &TrackerChoices::cascades, &CommonFlags::cascade},
}};

/// A file's name without folder and ending, else the value; ':' and ',' are no characters of a folder's name.
std::string setting_name(const TrackerFlag& flag, const std::string& value) {
  std::string name = flag.value == &CommonFlags::config_file ? std::filesystem::path(value).stem().string() : value;
  std::ranges::replace(name, ':', '-');
  std::ranges::replace(name, ',', '_');
  if (is_program(value)) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return c != '.' && c != '_' && !std::isalnum(c); }, '-');
    name.resize(std::min<size_t>(name.size(), 64));
  }
  return checked_name(name, flag.name, "name of a setting");
}

/// Null if no flag has several values.
const TrackerFlag* several_of(const TrackerChoices& choices) {
  const TrackerFlag* several = nullptr;
  for (const TrackerFlag& flag : kTrackerFlags) {
    if ((choices.*flag.values).size() < 2) continue;
    if (several)
      throw Error(flag.name, "values", fmt::format("several, as of {}", several->name),
                  "one flag with several; to compare more, put each setting into a file: --config a.json --config "
                  "b.json");
    several = &flag;
  }
  return several;
}

void check_settings(const std::vector<NamedTracker>& trackers, const char* flag) {
  for (size_t i = 0; i < trackers.size(); ++i) {
    for (size_t j = 0; j < i; ++j)
      if (trackers[i].name == trackers[j].name)
        throw Error(flag, "settings", trackers[i].name + " twice", "settings of different names");
    if (to_json(trackers[i].tracker).at("database") != to_json(trackers[0].tracker).at("database"))
      throw Error(flag, "database.* of " + trackers[i].name, "other views than those of " + trackers[0].name,
                  "the same databases for all settings");
  }
}

}  // namespace

void CommonFlags::add_tracker(Command command) {
  for (const TrackerFlag& flag : kTrackerFlags)
    command.group("Tracker").option(flag.name, this->*flag.value, flag.help);
}

void TrackerChoices::add(Command command) {
  const CommonFlags common;
  for (const TrackerFlag& flag : kTrackerFlags) {
    const std::string& preset = common.*flag.value;
    const std::string help = flag.help + (preset.empty() ? "" : fmt::format(" [{}]", preset));
    command.group("Tracker").option(flag.name, this->*flag.values, help).repeated();
  }
}

void TrackerChoices::choose(CommonFlags& common) const {
  several_of(*this);
  for (const TrackerFlag& flag : kTrackerFlags)
    if (!(this->*flag.values).empty()) common.*flag.value = (this->*flag.values).front();
}

bool TrackerChoices::are_several() const { return several_of(*this) != nullptr; }

std::vector<NamedTracker> TrackerChoices::trackers(const CommonFlags& common) const {
  const TrackerFlag* flag = several_of(*this);
  check(flag != nullptr, "there are several settings");
  std::vector<NamedTracker> trackers;
  for (const std::string& value : this->*flag->values) {
    CommonFlags one = common;
    one.*flag->value = value;
    trackers.push_back({setting_name(*flag, value), one.tracker_config()});
  }
  const TrackerConfig paper = profile("paper");
  const auto is_paper = [paper = to_json(paper)](const NamedTracker& each) {
    return to_json(each.tracker) == paper;
  };
  if (std::ranges::none_of(trackers, is_paper)) trackers.insert(trackers.begin(), {"paper", paper});
  check_settings(trackers, flag->name);
  return trackers;
}

void ComparisonFlags::add(Command command, const std::string& default_metrics) {
  std::vector<std::string> known;
  for (const reports::Metric& metric : reports::gated_metrics()) known.emplace_back(metric.key);
  command
      .option("--metrics", metrics,
              "metrics to compare, chosen before you look: fewer make narrower intervals [" + default_metrics + "]")
      .one_of(known)
      .repeated()
      .comma_separated();
  command.option("--confidence", confidence, "with which all intervals hold together").in(0.5, 0.9999);
}

reports::CompareConfig ComparisonFlags::config() const {
  refuse_twice("--metrics", metrics);
  constexpr double kSteps = 1e6;  // so that 1 - 0.99 is 0.01
  reports::CompareConfig config;
  config.family_error = std::round((1 - confidence) * kSteps) / kSteps;
  return config;
}

}  // namespace glovebench::eval
