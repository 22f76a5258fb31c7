#include "eval/workbench.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/adapters/process/process_method.h"
#include "core/base/error.h"
#include "eval/color_table_cache.h"
#include "eval/program.h"
#include "eval/terminal.h"
#include "render/label_renderer.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {

std::unique_ptr<Method> make_method(const MethodInputs& inputs) {
  const std::string& method = inputs.config.method;
  return is_program(method) ? make_process_method(inputs) : find_method(method).make(inputs);
}

bool shows_stages(const std::string& method) { return !is_program(method) && find_method(method).sees_depth; }

Workbench::Workbench(WorkbenchConfig config) : config_(std::move(config)) {}

std::shared_ptr<const HandModel> Workbench::model() {
  const std::lock_guard lock(mutex_);
  if (!config_.hand) return package_hand();
  if (!model_)
    model_ = std::make_shared<HandModel>(HandModel::load(hand_mesh_path(), config_.side, config_.hand->shape));
  return model_;
}

std::shared_ptr<const HandModel> Workbench::package_hand() {
  const std::lock_guard lock(mutex_);
  if (!package_hand_) package_hand_ = std::make_shared<HandModel>(HandModel::load(hand_mesh_path(), config_.side));
  return package_hand_;
}

render::Subject Workbench::subject(int number) {
  const std::lock_guard lock(mutex_);
  const auto known = subjects_.find(number);
  if (known != subjects_.end()) return known->second;
  return subjects_.emplace(number, render::make_subject(number, hand_mesh_path(), package_hand())).first->second;
}

std::shared_ptr<const ColorTable> Workbench::color_table(ColorSpace space) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const ColorTable>& table = color_tables_[space];
  if (!table) {
    const PostureSet postures = trajectories::posture_set(trajectory_folder(), "DB_open_pinch_power");
    table = std::make_shared<ColorTable>(cached_color_table(config_.cache_folder, package_hand(),
                                                            synthetic_calibration(), postures.postures, space));
  }
  return table;
}

std::shared_ptr<const Database> Workbench::database(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (const auto it = databases_.find(name); it != databases_.end()) return it->second;
  return database(postures_of(name));
}

std::shared_ptr<const Database> Workbench::database(const PostureSet& postures) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Database>& database = databases_[postures.name];
  if (!database) {
    Progress progress("building " + postures.name, config_.quiet);
    DatabaseCache cache = database_cache();
    cache.progress = [&](double share) { progress.show(share); };
    database = std::make_shared<Database>(cache.get(postures, *model(), config_.views, kTinySizes));
  }
  return database;
}

std::string Workbench::add_database(const std::string& name_or_file) {
  const bool is_built = name_or_file.ends_with(kDatabaseEnding);
  if (!is_built && !trajectories::is_posture_file(name_or_file)) return name_or_file;
  const std::lock_guard lock(mutex_);
  if (const auto known = added_.find(name_or_file); known != added_.end()) return known->second;
  std::shared_ptr<const Database> built;
  PostureSet postures;
  if (is_built) {
    built = std::make_shared<const Database>(Database::load(name_or_file));
    postures = built->posture_set();
    // The tracker itself refuses a database of the other side.
    const std::string expected = Database::input_hash(postures, *model(), config_.views);
    if (built->side() == config_.side && built->input_hash() != expected) {
      throw Error(name_or_file, "hash of its inputs", built->input_hash(),
                  expected + " (this hand and these views)");
    }
  } else {
    postures = trajectories::load_posture_set(name_or_file);
    if (const std::string doubt = trajectories::angle_doubt(postures.postures); !doubt.empty())
      say("glovebench: warning: {}: {}\n", name_or_file, doubt);
  }
  const auto& known = trajectories::posture_set_names();
  if (!is_built && std::find(known.begin(), known.end(), postures.name) != known.end())
    throw Error(name_or_file, "name", postures.name, "one that is not a built-in posture set's");
  if (databases_.contains(postures.name) || postures_.contains(postures.name))
    throw Error(name_or_file, "name", postures.name, "one not yet in the run");
  if (is_built) databases_[postures.name] = built;
  if (!is_built) postures_[postures.name] = postures;
  return added_[name_or_file] = postures.name;
}

bool Workbench::has_database(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return databases_.contains(name) ||
         std::filesystem::exists(database_cache().path(postures_of(name), *model(), config_.views));
}

DatabaseCache Workbench::database_cache() const {
  DatabaseCache cache;
  cache.folder = config_.cache_folder;
  cache.renderers = render::label_renderer_factory();
  cache.source_hash = render::database_source_hash();
  cache.threads = config_.threads;
  cache.memory = config_.memory;
  if (!config_.quiet) cache.message = [](const std::string& text) { say("glovebench: {}\n", text); };
  return cache;
}

PostureSet Workbench::postures_of(const std::string& name) const {
  const auto added = postures_.find(name);
  return added != postures_.end() ? added->second : trajectories::posture_set(trajectory_folder(), name);
}

std::unique_ptr<Method> Workbench::make_method(const TrackerConfig& config, const std::string& database_name) {
  return eval::make_method({config, config_.calibration, model(), database(database_name),
                            color_table(config.segmentation.color_space), render::label_renderer_factory()});
}

}  // namespace glovebench::eval
