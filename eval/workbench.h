#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/database/database.h"
#include "core/database/database_cache.h"
#include "core/hand/hand_file.h"
#include "core/methods/method.h"
#include "core/segmentation/color_table.h"
#include "render/subjects/subject.h"

namespace glovebench::eval {

struct WorkbenchConfig {
  std::string cache_folder;
  Side side = Side::right;
  std::optional<MeasuredHand> hand;  ///< the tracker's; empty: the package's
  int threads = 1;
  DatabaseMemory memory = DatabaseMemory::normal;  ///< of new databases
  bool quiet = false;
  ViewConfig views;
  RgbdCalibration calibration = synthetic_calibration();
};

/// `find_method` or, for "exec:COMMAND", a program.
/// Throws: Error.
std::unique_ptr<Method> make_method(const MethodInputs& inputs);
/// Does it begin with what `inspect` shows? False for a program.
bool shows_stages(const std::string& method);

/// Models, databases and color tables, made or loaded on first use. Thread-safe.
class Workbench {
 public:
  explicit Workbench(WorkbenchConfig config);

  const WorkbenchConfig& config() const { return config_; }
  std::shared_ptr<const HandModel> model();
  /// Subject 1's hand, and the tracker's unless `hand` is given.
  std::shared_ptr<const HandModel> package_hand();
  render::Subject subject(int number);
  const RgbdCalibration& calibration() const { return config_.calibration; }
  /// The table for the synthetic Kinect's cameras, not for `calibration`.
  std::shared_ptr<const ColorTable> color_table(ColorSpace space = ColorSpace::yuv);
  std::shared_ptr<const Database> database(const std::string& name);
  std::shared_ptr<const Database> database(const PostureSet& postures);
  /// Adds a database (*.glovedb) or postures (*.csv, *.json) and returns its name; returns other text unchanged.
  /// Throws: Error for another hand, other views or a taken name.
  std::string add_database(const std::string& name_or_file);
  /// True if `database(name)` builds nothing.
  bool has_database(const std::string& name);

  std::unique_ptr<Method> make_method(const TrackerConfig& config, const std::string& database_name);

 private:
  WorkbenchConfig config_;
  DatabaseCache database_cache() const;
  PostureSet postures_of(const std::string& name) const;

  std::recursive_mutex mutex_;
  std::shared_ptr<const HandModel> model_, package_hand_;
  std::map<int, render::Subject> subjects_;
  std::map<std::string, std::string> added_;    ///< database names by file
  std::map<std::string, PostureSet> postures_;  ///< of files, by name
  std::map<std::string, std::shared_ptr<const Database>> databases_;
  std::map<ColorSpace, std::shared_ptr<const ColorTable>> color_tables_;
};

}  // namespace glovebench::eval
