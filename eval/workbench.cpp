#include "eval/workbench.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "eval/color_table_cache.h"
#include "eval/progress.h"
#include "eval/share.h"
#include "render/label_renderer.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {

Workbench::Workbench(WorkbenchConfig config) : config_(std::move(config)), calibration_(synthetic_calibration()) {}

std::shared_ptr<const HandModel> Workbench::model() {
  return subject(1);
}

std::shared_ptr<const HandModel> Workbench::subject(int number) {
  if (number != 1 && number != 2) throw Error("subject", "number", std::to_string(number), "1 or 2");
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const HandModel>& model = subjects_[number];
  if (!model) {
    model = std::make_shared<HandModel>(
        HandModel::load(hand_mesh_path(), config_.side, number == 1 ? HandShape{} : second_subject()));
  }
  return model;
}

std::shared_ptr<const ColorTable> Workbench::color_table() {
  const std::lock_guard lock(mutex_);
  if (!color_table_) {
    const PostureSet postures = trajectories::posture_set(trajectory_folder(), "DB_open_pinch_power");
    color_table_ = std::make_shared<ColorTable>(
        cached_color_table(config_.cache_folder, model(), calibration_, postures.postures));
  }
  return color_table_;
}

std::shared_ptr<const Database> Workbench::database(const std::string& name) {
  return database(trajectories::posture_set(trajectory_folder(), name));
}

std::shared_ptr<const Database> Workbench::database(const PostureSet& postures) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Database>& database = databases_[postures.name];
  if (!database) {
    Progress progress("building " + postures.name, config_.quiet);
    DatabaseCache cache;
    cache.folder = config_.cache_folder;
    cache.renderers = render::label_renderer_factory();
    cache.threads = config_.threads;
    cache.message = [](const std::string& text) { fmt::print(stderr, "glovebench: {}\n", text); };
    cache.progress = [&](double share) { progress.show(share); };
    database = std::make_shared<Database>(cache.get(postures, *model(), config_.views, kTinySizes));
  }
  return database;
}

Tracker Workbench::make_tracker(const TrackerConfig& config, const std::string& database_name) {
  return Tracker(config, calibration_, model(), database(database_name), color_table());
}

}  // namespace glovebench::eval
