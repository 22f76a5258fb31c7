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
  DatabaseMemory memory = DatabaseMemory::normal;  ///< of databases that are built
  bool quiet = false;
  ViewConfig views;
  RgbdCalibration calibration = synthetic_calibration();  ///< of the synthetic Kinect; no lens distorts
};

/// What all experiments share and none changes: the hands, the calibration, the color table, the databases.
/// Everything is made or loaded when it is first asked for. Thread-safe.
class Workbench {
 public:
  explicit Workbench(WorkbenchConfig config);

  const WorkbenchConfig& config() const { return config_; }
  /// The tracker's hand.
  std::shared_ptr<const HandModel> model();
  /// The hand of the package's mesh as it is: the first subject's, and the tracker's unless a person's was
  /// measured.
  std::shared_ptr<const HandModel> package_hand();
  /// The hand in front of the camera (render::make_subject).
  render::Subject subject(int number);
  const RgbdCalibration& calibration() const { return config_.calibration; }
  /// Calibrated on pictures of the synthetic Kinect's own cameras, whatever the calibration: colors have no place.
  std::shared_ptr<const ColorTable> color_table(ColorSpace space = ColorSpace::yuv);
  /// A database by the name of its posture set, with the tiny-image sizes of the cascade.
  std::shared_ptr<const Database> database(const std::string& name);
  /// A database of these postures.
  std::shared_ptr<const Database> database(const PostureSet& postures);
  /// Makes a database of a file known under its name, which is returned: a built one (*.glovedb) or postures
  /// (*.csv, *.json). Any other text is the name of a posture set and is returned as it is. Throws Error if a built
  /// one was made for another hand or with other views, or if the name is taken.
  std::string add_database(const std::string& name_or_file);
  /// Whether `database` of this name will have nothing to build.
  bool has_database(const std::string& name);

  /// The configuration's method for a database.
  std::unique_ptr<Method> make_method(const TrackerConfig& config, const std::string& database_name);
  /// The paper's tracker, whose stages can be looked into. Throws Error if the configuration asks for another
  /// method.
  Tracker make_tracker(const TrackerConfig& config, const std::string& database_name);

 private:
  WorkbenchConfig config_;
  DatabaseCache database_cache() const;
  /// The postures of a name: of the program's data or of a file that was added.
  PostureSet postures_of(const std::string& name) const;

  std::recursive_mutex mutex_;
  std::shared_ptr<const HandModel> model_, package_hand_;
  std::map<int, render::Subject> subjects_;
  std::map<std::string, PostureSet> postures_;  ///< of files, by name
  std::map<std::string, std::shared_ptr<const Database>> databases_;
  std::map<ColorSpace, std::shared_ptr<const ColorTable>> color_tables_;
};

}  // namespace glovebench::eval
