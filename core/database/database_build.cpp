#include "core/database/database.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <filesystem>
#include <mutex>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/database/tiny_image.h"

namespace glovebench {
namespace {

/// Version of the text that input_hash hashes; content_hash covers what the builder makes of the inputs.
constexpr int kInputsVersion = 1;

PinholeCamera view_camera(const ViewConfig& views) {
  const double f = 0.5 * views.image_size / std::tan(0.5 * radians_from_degrees(views.field_of_view_deg));
  const double c = 0.5 * (views.image_size - 1);
  return {views.image_size, views.image_size, f, f, c, c};
}

void check_sizes(const std::string& name, std::span<const int> sizes) {
  if (sizes.empty()) throw Error(name, "tiny images", "no sizes", "at least one");
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] < kSmallestTinySize || sizes[i] > kLargestTinySize) {
      throw Error(name, "tiny images", fmt::format("{} px", sizes[i]),
                  fmt::format("{} to {} px", kSmallestTinySize, kLargestTinySize));
    }
    if (std::ranges::find(sizes.first(i), sizes[i]) != sizes.first(i).end())
      throw Error(name, "tiny images", fmt::format("{} px twice", sizes[i]), "each size once");
  }
}

}  // namespace

std::string Database::input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views) {
  std::string text = fmt::format("{}/{}/{}/{}/{}/{}/{}", kInputsVersion, postures.name, model.hash(),
                                 views.distance, views.field_of_view_deg, views.image_size, views.field_cap_share);
  for (size_t p = 0; p < postures.postures.size(); ++p) {
    text += "/" + postures.posture_names[p];
    for (const double angle : postures.postures[p]) text += fmt::format(",{}", angle);
  }
  return hash_text(text);
}

namespace {

/// All inputs but the tiny images' sizes.
struct BuildInputs {
  const PostureSet& postures;
  const HandModel& model;
  const ViewConfig& views;
  const ViewRendererFactory& renderers;
};

DatabaseLayout layout_of(const BuildInputs& inputs, std::span<const int> sizes, DatabaseMemory memory) {
  const auto& [postures, model, views, renderers] = inputs;
  check_sizes(postures.name, sizes);
  if (postures.postures.empty()) throw Error(postures.name, "postures", "none", "at least one");
  if (!(views.field_cap_share > 0 && views.field_cap_share <= 1))
    throw Error(postures.name, "field_cap_share", fmt::format("{}", views.field_cap_share), "above 0, at most 1");
  DatabaseHeader header{.postures = postures,
                        .side = model.side(),
                        .input_hash = Database::input_hash(postures, model, views),
                        .memory = memory,
                        .field_cap_share = views.field_cap_share,
                        .sizes_px = {sizes.begin(), sizes.end()}};
  return DatabaseLayout(std::move(header));
}

/// Draws entries and writes what is held of them into the sections of a file.
class Filler {
 public:
  Filler(const BuildInputs& inputs, const DatabaseLayout& layout, std::span<uint8_t> file)
      : inputs_(inputs), layout_(layout), file_(file), camera_(view_camera(inputs.views)) {}

  /// Renders one view and writes what is held of it.
  void fill_entry(ViewRenderer& renderer, const PosedHand& hand, int entry) const {
    Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
    T_view_hand.linear() = view_rotations()[Database::view(entry)];
    T_view_hand.translation().z() = inputs_.views.distance;
    const LabelImage image = renderer.render_labels(inputs_.model, hand, camera_, T_view_hand);
    const Square square = bounding_square(image);
    check(square.side > 0, "the hand is in every view");
    reinterpret_cast<Eigen::Vector3d*>(file_.data() + layout_.box_rays().offset)[entry] =
        square_ray(square, camera_);
    for (const auto& [size, sections] : layout_.sizes()) {
      const LabelImage tiny = make_tiny_image(image, square, size);
      pack_labels(tiny, part(sections.labels, entry, packed_bytes(tiny.size())));
      if (sections.fields.bytes > 0)
        chamfer_fields(tiny, field_cap(inputs_.views.field_cap_share, size),
                       part(sections.fields, entry, tiny.size() * kColorCount));
    }
  }

 private:
  std::span<uint8_t> part(const Section& section, int entry, size_t entry_bytes) const {
    return file_.subspan(section.offset + entry * entry_bytes, entry_bytes);
  }

  const BuildInputs& inputs_;
  const DatabaseLayout& layout_;
  std::span<uint8_t> file_;
  PinholeCamera camera_;
};

/// Writes a whole database of this layout, posture after posture.
void fill(const BuildInputs& inputs, DatabaseLayout& layout, int threads,
          const std::function<void(double)>& progress, MappedMemory& file) {
  const int count = static_cast<int>(inputs.postures.postures.size()) * kViewCount;
  const Filler filler(inputs, layout, file.writable());
  tbb::enumerable_thread_specific<std::unique_ptr<ViewRenderer>> renderers;  // each belongs to its thread
  std::atomic<int> done{0};
  std::mutex progress_mutex;
  constexpr int kPiece = DatabaseLayout::kPieceEntries;  // a task: one posture is posed once a piece
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(0, count / kPiece, [&](int piece) {
      std::unique_ptr<ViewRenderer>& renderer = renderers.local();
      if (!renderer) renderer = inputs.renderers();
      const PosedHand hand = inputs.model.pose(inputs.postures.postures[piece * kPiece / kViewCount]);
      for (int i = 0; i < kPiece; ++i) filler.fill_entry(*renderer, hand, piece * kPiece + i);
      const int finished = done += kPiece;
      if (finished % kViewCount == 0) file.release(0, file.bytes().size());
      if (!progress) return;
      const std::lock_guard lock(progress_mutex);
      progress(static_cast<double>(finished) / count);
    });
    layout.seal(file);
  });
}

}  // namespace

Database Database::build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                         const ViewRendererFactory& renderers, int threads,
                         const std::function<void(double)>& progress, std::span<const int> sizes,
                         DatabaseMemory memory) {
  const BuildInputs inputs{postures, model, views, renderers};
  DatabaseLayout layout = layout_of(inputs, sizes, memory);
  auto bytes = std::make_shared<MappedMemory>(MappedMemory::zeros(layout.bytes()));
  fill(inputs, layout, threads, progress, *bytes);
  return tbb::task_arena(threads).execute(
      [&] { return Database(bytes, layout, layout.read_sections(*bytes, postures.name, sizes)); });
}

std::string Database::build_file(const std::string& path, const PostureSet& postures, const HandModel& model,
                                 const ViewConfig& views, const ViewRendererFactory& renderers, int threads,
                                 const std::function<void(double)>& progress, std::span<const int> sizes,
                                 DatabaseMemory memory) {
  const BuildInputs inputs{postures, model, views, renderers};
  DatabaseLayout layout = layout_of(inputs, sizes, memory);
  // A killed build leaves a file as large as a database.
  remove_leftovers(folder_above(path),
                   [&](const std::string& name) { return name == std::filesystem::path(path).filename(); });
  WholeFile file(path);
  MappedMemory bytes = file.map(layout.bytes());
  fill(inputs, layout, threads, progress, bytes);
  file.commit();
  return layout.content_hash();
}

}  // namespace glovebench
