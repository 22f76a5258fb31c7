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
#include "core/base/file.h"
#include "core/base/hash.h"
#include "core/database/packed_labels.h"

namespace glovebench {
namespace {

/// Changes whenever the same inputs would give another database.
constexpr int kBuilderVersion = 1;

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
    if (std::ranges::find(sizes.first(i), sizes[i]) != sizes.first(i).end()) {
      throw Error(name, "tiny images", fmt::format("{} px twice", sizes[i]), "each size once");
    }
  }
}

}  // namespace

uint8_t field_cap(double cap_share, int size) {
  return static_cast<uint8_t>(std::clamp(std::lround(cap_share * size * kFieldScale), 1l, 255l));
}

std::string Database::input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views) {
  std::string text = fmt::format("{}/{}/{}/{}/{}/{}/{}", kBuilderVersion, postures.name, model.hash(),
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
  if (!(views.field_cap_share > 0 && views.field_cap_share <= 1)) {
    throw Error(postures.name, "field_cap_share", fmt::format("{}", views.field_cap_share), "above 0, at most 1");
  }
  DatabaseHeader header{.postures = postures,
                        .side = model.side(),
                        .hash = Database::input_hash(postures, model, views),
                        .memory = memory,
                        .field_cap_share = views.field_cap_share,
                        .sizes_px = {sizes.begin(), sizes.end()}};
  return DatabaseLayout(std::move(header));
}

/// Draws entries and writes what is held of them into the sections of a file.
class Filler {
 public:
  Filler(const BuildInputs& inputs, const DatabaseLayout& layout, std::span<uint8_t> file)
      : inputs_(inputs), layout_(layout), file_(file), camera_(view_camera(inputs.views)) {
    const int count = static_cast<int>(inputs.postures.postures.size()) * kViewCount;
    for (const auto& [size, sections] : layout.sizes())
      rows_.emplace(size, FieldRows(size, layout.header().memory, count));
  }

  /// Renders one view and writes what is held of it. `scratch` is the caller's, for fields that are not stored.
  void fill_entry(ViewRenderer& renderer, const PosedHand& hand, int entry, std::vector<uint8_t>& scratch) const {
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
      const size_t field_bytes = tiny.size() * kColorCount;
      scratch.resize(std::max(scratch.size(), field_bytes));
      const std::span<uint8_t> fields = sections.fields.bytes > 0 ? part(sections.fields, entry, field_bytes)
                                                                  : std::span(scratch).first(field_bytes);
      for (int color = 1; color <= kColorCount; ++color)
        chamfer_field(tiny, static_cast<uint8_t>(color), field_cap(inputs_.views.field_cap_share, size),
                      fields.subspan((color - 1) * tiny.size(), tiny.size()));
      rows_.at(size).put(entry, fields.data(), file_.subspan(sections.rows.offset, sections.rows.bytes));
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
  std::map<int, FieldRows> rows_;  ///< their shapes
};

/// What a thread needs to draw views.
struct Drawing {
  std::unique_ptr<ViewRenderer> renderer;  ///< belongs to the thread that made it
  std::vector<uint8_t> scratch;
};

/// Writes a whole database of this layout, posture after posture.
void fill(const BuildInputs& inputs, const DatabaseLayout& layout, int threads,
          const std::function<void(double)>& progress, MappedMemory& file) {
  const int count = static_cast<int>(inputs.postures.postures.size()) * kViewCount;
  const Filler filler(inputs, layout, file.writable());
  tbb::enumerable_thread_specific<Drawing> thread_drawings;
  std::atomic<int> done{0};
  std::mutex progress_mutex;
  constexpr int kBlock = 54;  // entries a task: one posture is posed once a block
  static_assert(kViewCount % kBlock == 0);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(0, count / kBlock, [&](int block) {
      Drawing& drawing = thread_drawings.local();
      if (!drawing.renderer) drawing.renderer = inputs.renderers();
      const PosedHand hand = inputs.model.pose(inputs.postures.postures[block * kBlock / kViewCount]);
      for (int i = 0; i < kBlock; ++i)
        filler.fill_entry(*drawing.renderer, hand, block * kBlock + i, drawing.scratch);
      const int finished = done += kBlock;
      if (finished % kViewCount == 0) file.release(0, file.bytes().size());
      if (!progress) return;
      const std::lock_guard lock(progress_mutex);
      progress(static_cast<double>(finished) / count);
    });
    layout.seal(file);
  });
}

/// A section, in memory that large pages make up. What was copied of a low-memory database's file does not stay
/// resident twice.
std::shared_ptr<const MappedMemory> copy_of(const MappedMemory& file, const Section& section,
                                            DatabaseMemory memory) {
  auto copy = std::make_shared<MappedMemory>(MappedMemory::zeros(section.bytes));
  constexpr size_t kPiece = 4 << 20;
  tbb::parallel_for(size_t{0}, (section.bytes + kPiece - 1) / kPiece, [&](size_t piece) {
    const size_t begin = piece * kPiece, bytes = std::min(kPiece, section.bytes - begin);
    std::ranges::copy(file.bytes().subspan(section.offset + begin, bytes),
                      copy->writable().begin() + static_cast<ptrdiff_t>(begin));
    if (memory == DatabaseMemory::low) file.release(section.offset + begin, bytes);
  });
  return copy;
}

}  // namespace

Database Database::build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                         const ViewRendererFactory& renderers, int threads,
                         const std::function<void(double)>& progress, std::span<const int> sizes,
                         DatabaseMemory memory) {
  const BuildInputs inputs{postures, model, views, renderers};
  const DatabaseLayout layout = layout_of(inputs, sizes, memory);
  auto bytes = std::make_shared<MappedMemory>(MappedMemory::zeros(layout.bytes()));
  fill(inputs, layout, threads, progress, *bytes);
  return Database(bytes, layout, sizes);
}

void Database::build_file(const std::string& path, const PostureSet& postures, const HandModel& model,
                          const ViewConfig& views, const ViewRendererFactory& renderers, int threads,
                          const std::function<void(double)>& progress, std::span<const int> sizes,
                          DatabaseMemory memory) {
  const BuildInputs inputs{postures, model, views, renderers};
  const DatabaseLayout layout = layout_of(inputs, sizes, memory);
  WholeFile file(path);
  MappedMemory bytes = file.map(layout.bytes());
  fill(inputs, layout, threads, progress, bytes);
  file.commit();
}

void Database::save(const std::string& path) const {
  const std::span<const uint8_t> bytes = bytes_->bytes();
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Database Database::load(const std::string& path, std::span<const int> sizes) {
  const auto bytes = std::make_shared<const MappedMemory>(MappedMemory::of_file(path));
  const DatabaseLayout layout(bytes->bytes(), path);
  layout.check_sections(*bytes, path, sizes);
  return Database(bytes, layout, sizes);
}

Database::Database(std::shared_ptr<const MappedMemory> bytes, const DatabaseLayout& layout,
                   std::span<const int> sizes)
    : bytes_(std::move(bytes)), header_(layout.header()) {
  const uint8_t* const file = bytes_->bytes().data();
  box_rays_ = reinterpret_cast<const Eigen::Vector3d*>(file + layout.box_rays().offset);
  for (const auto& [size, sections] : layout.sizes()) {
    if (std::ranges::find(sizes, size) == sizes.end()) continue;
    const auto rows = copy_of(*bytes_, sections.rows, memory());
    if (memory() == DatabaseMemory::low) bytes_->expect_random_reads(sections.labels.offset, sections.labels.bytes);
    sizes_[size] = {file + sections.labels.offset,
                    sections.fields.bytes > 0 ? file + sections.fields.offset : nullptr, rows,
                    FieldRows(size, memory(), entry_count(), rows->bytes())};
  }
}

const Database::SizeData& Database::data(int size) const {
  const auto it = sizes_.find(size);
  if (it == sizes_.end()) {
    throw Error("database " + header_.postures.name, "tiny images", fmt::format("no {} px", size),
                "a size that was loaded");
  }
  return it->second;
}

LabelImage Database::labels(int size, int entry) const {
  const size_t bytes = packed_bytes(static_cast<size_t>(size) * size);
  return unpack_labels({data(size).labels + entry * bytes, bytes}, size, size);
}

const uint8_t* Database::fields(int size, int entry) const {
  const uint8_t* const fields = data(size).fields;
  if (fields == nullptr) {
    throw Error("database " + header_.postures.name, "fields", "a low-memory database", "one that stores them");
  }
  return fields + static_cast<size_t>(entry) * size * size * kColorCount;
}

}  // namespace glovebench
