// The steps that make one entry of the database, the whole build, and loading it again.

#include <filesystem>

#include "bench/bench_data.h"
#include "core/base/math.h"
#include "core/database/database_cache.h"
#include "core/database/distance_field.h"
#include "render/label_renderer.h"

namespace glovebench::bench {
namespace {

/// Views of the database's first posture, all around the hand.
class Views {
 public:
  Views() : hand_(data().model->pose(data().postures.postures[0])) {
    const ViewConfig& views = data().config.views;
    const double f = 0.5 * views.image_size / std::tan(0.5 * radians_from_degrees(views.field_of_view_deg));
    const double c = 0.5 * (views.image_size - 1);
    camera_ = {views.image_size, views.image_size, f, f, c, c};
    for (int view = 0; view < kViewCount; view += kStep) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = view_rotations()[view];
      T.translation().z() = views.distance;
      T_view_hand_.push_back(T);
    }
  }
  std::vector<LabelImage> render(ViewRenderer& renderer) const {
    std::vector<LabelImage> images;
    for (const Eigen::Isometry3d& T : T_view_hand_)
      images.push_back(renderer.render_labels(*data().model, hand_, camera_, T));
    return images;
  }

 private:
  static constexpr int kStep = 37;
  PosedHand hand_;
  PinholeCamera camera_;
  std::vector<Eigen::Isometry3d> T_view_hand_;
};

std::vector<LabelImage> rendered_views() {
  render::LabelRenderer renderer;
  return Views().render(renderer);
}

void render_views(benchmark::State& state) {
  render::LabelRenderer renderer;
  const Views views;
  const std::vector<LabelImage> first = views.render(renderer);
  if (views.render(renderer) != first) return state.SkipWithError("a view drawn twice is not the same");
  for (auto _ : state) benchmark::DoNotOptimize(views.render(renderer));
  set_time_each(state, "view", first.size());
}
BENCHMARK(render_views)->Name("database/render_view")->Unit(benchmark::kMillisecond);

using MakeTinyImage = LabelImage (*)(const LabelImage&, const Square&, int);

void run_tiny_images(benchmark::State& state, MakeTinyImage make) {
  const std::vector<LabelImage> views = rendered_views();
  for (const LabelImage& view : views) {
    for (const int size : kTinySizes) {
      const Square square = bounding_square(view);
      if (make(view, square, size) != make_tiny_image_plain(view, square, size))
        return state.SkipWithError("the fast tiny image differs from the plain one");
    }
  }
  for (auto _ : state) {
    for (const LabelImage& view : views) {
      const Square square = bounding_square(view);
      for (const int size : kTinySizes) benchmark::DoNotOptimize(make(view, square, size));
    }
  }
  set_time_each(state, "view", views.size());
}

BENCHMARK_CAPTURE(run_tiny_images, plain, make_tiny_image_plain)
    ->Name("database/tiny_images/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_tiny_images, fast, make_tiny_image)
    ->Name("database/tiny_images/fast")
    ->Unit(benchmark::kMillisecond);

using ChamferField = void (*)(const LabelImage&, uint8_t, uint8_t, std::span<uint8_t>);

/// All fields of a view, one after the other.
std::vector<uint8_t> fields_of(const std::vector<LabelImage>& tiny, ChamferField chamfer) {
  std::vector<uint8_t> fields;
  for (const LabelImage& image : tiny) {
    for (int color = 1; color <= kColorCount; ++color) {
      const size_t begin = fields.size();
      fields.resize(begin + image.size());
      const auto cap = static_cast<uint8_t>(kFieldScale * image.width() / 2);
      chamfer(image, static_cast<uint8_t>(color), cap, std::span(fields).subspan(begin));
    }
  }
  return fields;
}

void run_fields(benchmark::State& state, ChamferField chamfer) {
  std::vector<std::vector<LabelImage>> views;
  for (const LabelImage& view : rendered_views()) {
    const Square square = bounding_square(view);
    std::vector<LabelImage>& tiny = views.emplace_back();
    for (const int size : kTinySizes) tiny.push_back(make_tiny_image(view, square, size));
    if (fields_of(tiny, chamfer) != fields_of(tiny, chamfer_field_plain))
      return state.SkipWithError("the fast fields differ from the plain ones");
  }
  time_each(state, "view", views, [&](const std::vector<LabelImage>& tiny) { return fields_of(tiny, chamfer); });
}

BENCHMARK_CAPTURE(run_fields, plain, chamfer_field_plain)
    ->Name("database/fields/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_fields, fast, chamfer_field)->Name("database/fields/fast")->Unit(benchmark::kMillisecond);

/// The 756 views of one posture on one thread.
void build(benchmark::State& state) {
  const PostureSet one{"one", {data().postures.posture_names[0]}, {data().postures.postures[0]}};
  for (auto _ : state) {
    const Database database =
        Database::build(one, *data().model, data().config.views, render::label_renderer_factory(), 1);
    for (const int size : kTinySizes) {
      for (int view = 0; view < kViewCount; ++view)
        if (database.labels(size, view) != data().database->labels(size, view))
          return state.SkipWithError("the posture built alone differs from the one in the database");
    }
  }
  set_time_each(state, "view", kViewCount);
}
BENCHMARK(build)->Name("database/build")->Unit(benchmark::kMillisecond)->Iterations(1);

/// A cached database with all sizes: reading, and the checksum of every byte.
void load(benchmark::State& state) {
  const DatabaseCache cache = data().cache();
  for (auto _ : state) {
    const Database database = cache.get(data().postures, *data().model, data().config.views, kTinySizes);
    if (database.content_hash() != data().database->content_hash())
      return state.SkipWithError("another database was loaded");
  }
  const auto bytes = static_cast<double>(
      std::filesystem::file_size(cache.path(data().postures, *data().model, data().config.views)));
  state.counters["bytes_entry"] = bytes / data().database->entry_count();
  state.counters["bytes_s"] =
      benchmark::Counter(bytes, benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
}
BENCHMARK(load)->Name("database/load")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
