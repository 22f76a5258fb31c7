#include "core/database/database.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>
#include <numbers>

#include "core/base/angles.h"
#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/hash.h"

namespace glovebench {
namespace {

/// Changes whenever the same inputs would give another database.
constexpr int kBuilderVersion = 1;

PinholeCamera view_camera(const ViewConfig& views) {
  const double f = 0.5 * views.image_size / std::tan(0.5 * radians_from_degrees(views.field_of_view_deg));
  const double c = 0.5 * (views.image_size - 1);
  return {views.image_size, views.image_size, f, f, c, c};
}

/// px. Larger images do not fit: chamfer_field steps at most 64 px along a row, and a stored distance is a byte,
/// also when the cap is the whole side. Smaller ones tell nothing.
constexpr int kSmallestSize = 4, kLargestSize = 64;

void check_sizes(const std::string& name, std::span<const int> sizes) {
  if (sizes.empty()) throw Error(name, "tiny images", "no sizes", "at least one");
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] < kSmallestSize || sizes[i] > kLargestSize) {
      throw Error(name, "tiny images", fmt::format("{} px", sizes[i]),
                  fmt::format("{} to {} px", kSmallestSize, kLargestSize));
    }
    if (std::ranges::find(sizes.first(i), sizes[i]) != sizes.first(i).end()) {
      throw Error(name, "tiny images", fmt::format("{} px twice", sizes[i]), "each size once");
    }
  }
}

uint8_t field_cap(const ViewConfig& views, int size) {
  return static_cast<uint8_t>(std::clamp(std::lround(views.field_cap_share * size * kFieldScale), 1l, 255l));
}

}  // namespace

std::string Database::input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views) {
  std::string text = fmt::format("{}/{}/{}/{}/{}/{}/{}", kBuilderVersion, postures.name, model.hash(),
                                 views.distance, views.field_of_view_deg, views.image_size, views.field_cap_share);
  for (size_t p = 0; p < postures.postures.size(); ++p) {
    text += "/" + postures.posture_names[p];
    for (const double angle : postures.postures[p]) text += fmt::format(",{}", angle);
  }
  return hash_text(text);
}

Database Database::build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                         const ViewRendererFactory& renderers, int threads,
                         const std::function<void(double)>& progress, std::span<const int> sizes) {
  check_sizes(postures.name, sizes);
  if (postures.postures.empty()) throw Error(postures.name, "postures", "none", "at least one");
  Database database;
  database.postures_ = postures;
  database.side_ = model.side();
  database.hash_ = input_hash(postures, model, views);
  const int count = database.entry_count();
  database.box_rays_.resize(count);
  for (const int size : sizes) {
    const size_t pixels = static_cast<size_t>(size) * size;
    database.sizes_[size].labels.resize(count * pixels);
    database.sizes_[size].fields.resize(count * pixels * kColorCount + kBehind);
  }

  const PinholeCamera camera = view_camera(views);
  const auto fill_entry = [&](ViewRenderer& renderer, const PosedHand& hand, int entry) {
    Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
    T_view_hand.linear() = view_rotations()[view(entry)];
    T_view_hand.translation().z() = views.distance;
    const LabelImage image = renderer.render_labels(model, hand, camera, T_view_hand);
    const Square square = bounding_square(image);
    check(square.side > 0, "the hand is in every view");
    database.box_rays_[entry] = square_ray(square, camera);
    for (auto& [size, data] : database.sizes_) {
      const size_t pixels = static_cast<size_t>(size) * size;
      const LabelImage tiny = make_tiny_image(image, square, size);
      std::copy(tiny.begin(), tiny.end(), data.labels.begin() + entry * pixels);
      for (int color = 1; color <= kColorCount; ++color) {
        const std::span field(
            data.fields.data() + (size_t{static_cast<unsigned>(entry)} * kColorCount + color - 1) * pixels, pixels);
        chamfer_field(tiny, static_cast<uint8_t>(color), field_cap(views, size), field);
      }
    }
  };

  // A renderer belongs to the thread that made it.
  tbb::enumerable_thread_specific<std::unique_ptr<ViewRenderer>> thread_renderers;
  std::atomic<int> done{0};
  std::mutex progress_mutex;
  constexpr int kBlock = 54;  // entries a task: one posture is posed once a block
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(0, count / kBlock, [&](int block) {
      std::unique_ptr<ViewRenderer>& renderer = thread_renderers.local();
      if (!renderer) renderer = renderers();
      const PosedHand hand = model.pose(database.posture(block * kBlock));
      for (int i = 0; i < kBlock; ++i) fill_entry(*renderer, hand, block * kBlock + i);
      const int finished = done += kBlock;
      if (!progress) return;
      const std::lock_guard lock(progress_mutex);
      progress(static_cast<double>(finished) / count);
    });
    database.arrange_rows();
  });
  return database;
}

void Database::arrange_rows() {
  for (auto& [size, data] : sizes_) data.rows = FieldRows(data.fields.data(), size, entry_count());
}

const Database::SizeData& Database::data(int size) const {
  const auto it = sizes_.find(size);
  if (it == sizes_.end()) {
    throw Error("database " + postures_.name, "tiny images", fmt::format("no {} px", size),
                "a size that was loaded");
  }
  return it->second;
}

const uint8_t* Database::labels(int size, int entry) const {
  return data(size).labels.data() + static_cast<size_t>(entry) * size * size;
}

const uint8_t* Database::fields(int size, int entry) const {
  return data(size).fields.data() + static_cast<size_t>(entry) * size * size * kColorCount;
}

}  // namespace glovebench
