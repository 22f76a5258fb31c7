#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "eval/studies/settings.h"

namespace glovebench::eval {

/// One way to do a thing, as a row of the table.
struct AblationRow {
  std::string label;    ///< to read: "color-blind"
  std::string setting;  ///< a name of `ablation_settings`
  std::string database;
};
/// The same thing done in several ways, over the same frames. The first row is what the others are compared with.
struct Ablation {
  std::string name;
  std::vector<AblationRow> rows;
};

/// The setting that every other one departs from in one respect.
inline constexpr const char* kDefaultSetting = "default";
/// All settings that rows may name.
std::vector<Setting> ablation_settings(const TrackerConfig& tracker);
/// What the tracker, its database or the scene is changed in; but for the choice of postures. The labels
/// of default rows are true of the profile `paper`.
std::vector<Ablation> ablations();

/// What settings came to on the source truth, by setting and database. Each is run once, whoever asks for it. With
/// DB_open_power over the movements that grasp like that, with all others over all five.
class AblationRuns {
 public:
  /// Runs what the rows of these ablations name.
  AblationRuns(const StudyContext& context, const std::vector<Ablation>& wanted);
  /// One that was run elsewhere.
  void add(const std::string& setting, const std::string& database, Passes passes);
  /// One that was run; any other is a broken invariant.
  const Passes& at(const std::string& setting, const std::string& database) const;

 private:
  std::map<std::pair<std::string, std::string>, Passes> passes_;
};

/// Of a table that compares settings: the three errors, and after each its change with the ends of the interval.
const std::vector<reports::Column>& error_columns();

/// The table "ablations": a row each.
reports::Table ablation_table(const AblationRuns& runs, const std::vector<Ablation>& ablations);

}  // namespace glovebench::eval
