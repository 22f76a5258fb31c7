#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "core/base/mapped_memory.h"
#include "core/database/database_file.h"
#include "core/database/distance_field.h"
#include "core/database/field_rows.h"
#include "core/database/posture_set.h"
#include "core/database/tiny_image.h"
#include "core/database/view_sphere.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// How the views of a posture are rendered.
struct ViewConfig {
  double distance = 0.75;           ///< camera to hand origin, m
  double field_of_view_deg = 24.0;  ///< of the square image
  int image_size = 192;             ///< px
  double field_cap_share = 0.5;  ///< largest distance, also that of an absent color, as a share of the side, (0, 1]
};

/// The largest value of a field, also that of an absent color, 1/kFieldScale px.
uint8_t field_cap(double cap_share, int size);

/// The image database of section III: 756 views of each posture, as tiny images of several sizes with one
/// distance field a color, which a low-memory database makes when it is asked for (look_up_parts.h). Entry =
/// posture
/// * 756 + view. Immutable, shared between threads; copies share the memory.
class Database {
 public:
  /// Renders all views; the renderer factory is called once a thread. The result does not depend on `threads`.
  /// `progress`, if given, hears the share done (0..1). `sizes` are the tiny images' edge lengths, 4..64 px; what
  /// is stored of one does not depend on the others, nor does `input_hash()`. Throws Error for another size, a size
  /// named twice or no postures.
  static Database build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                        const ViewRendererFactory& renderers, int threads,
                        const std::function<void(double)>& progress = {}, std::span<const int> sizes = kTinySizes,
                        DatabaseMemory memory = DatabaseMemory::normal);
  /// The same into a file, which may be larger than memory: what was written of a posture does not stay resident.
  /// Returns its `content_hash()`. Throws Error also for want of room on the disk.
  static std::string build_file(const std::string& path, const PostureSet& postures, const HandModel& model,
                                const ViewConfig& views, const ViewRendererFactory& renderers, int threads,
                                const std::function<void(double)>& progress = {},
                                std::span<const int> sizes = kTinySizes,
                                DatabaseMemory memory = DatabaseMemory::normal);

  /// A versioned, checksummed file (database_file.h).
  void save(const std::string& path) const;
  /// `sizes` are the tiny-image sizes that are wanted, of those that the file has. All bytes of these are read and
  /// checked, so that no look-up reads elsewhere or returns an entry that does not exist. `check` finds more.
  /// Labels and fields stay in the file (MappedMemory::of_file says what that asks of it) and take memory that the
  /// system can take back; the rows are made of the fields, which a low-memory database makes of its labels. Uses
  /// the threads of the caller's TBB arena. Throws Error naming the file and what is wrong with it.
  static Database load(const std::string& path, std::span<const int> sizes = kTinySizes);
  /// Throws Error naming the database unless its fields are those of its labels, in all sizes that were loaded.
  /// Takes about as long as making them. Uses the threads of the caller's TBB arena.
  void check() const;
  /// Throws Error if the file that it was loaded from was written to since. Takes less than a microsecond.
  void require_unchanged() const { bytes_->require_unchanged(); }
  /// What a database made of these inputs would have as `input_hash()`.
  static std::string input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views);

  int entry_count() const { return static_cast<int>(header_.postures.postures.size()) * kViewCount; }
  const PostureSet& posture_set() const { return header_.postures; }
  const Posture& posture(int entry) const { return header_.postures.postures[entry / kViewCount]; }
  static int view(int entry) { return entry % kViewCount; }
  /// Direction, in the view's camera, from the camera to the center of the hand's bounding square.
  const Eigen::Vector3d& box_ray(int entry) const { return box_rays_[entry]; }
  Side side() const { return header_.side; }
  /// Hash of all inputs, the same however much memory it takes.
  const std::string& input_hash() const { return header_.input_hash; }
  /// Hash of what it holds (DatabaseLayout::content_hash), the same however much memory it takes.
  const std::string& content_hash() const { return content_hash_; }
  DatabaseMemory memory() const { return header_.memory; }

  /// Labels of one entry, size*size. Throws Error if that size was not loaded.
  LabelImage labels(int size, int entry) const;
  /// Distance fields of one entry: kColorCount fields of size*size, in steps of 1/kFieldScale px, chamfer metric,
  /// capped at `field_cap`. Throws Error as `labels` does, and for a low-memory database, which holds none.
  const uint8_t* fields(int size, int entry) const;
  /// What made fields of a size are capped at to equal stored ones, 1/kFieldScale px.
  uint8_t field_cap(int size) const { return glovebench::field_cap(header_.field_cap_share, size); }
  /// The same fields, arranged for a look at all entries at once. Throws Error as `labels` does.
  const FieldRows& field_rows(int size) const { return *data(size).rows; }
  bool has_size(int size) const { return sizes_.contains(size); }

 private:
  struct SizeData {
    const uint8_t* labels = nullptr;  ///< [entry][packed_bytes(pixels)]
    const uint8_t* fields = nullptr;  ///< [entry][color][pixel]; kBehind bytes more may be read; none: low memory
    const FieldRows* rows = nullptr;
  };

  /// `rows`: by size of the tiny images, px.
  Database(std::shared_ptr<const MappedMemory> bytes, const DatabaseLayout& layout, std::map<int, FieldRows> rows);
  const SizeData& data(int size) const;

  std::shared_ptr<const MappedMemory> bytes_;  ///< as in the file
  DatabaseHeader header_;
  std::string content_hash_;
  std::shared_ptr<const std::map<int, FieldRows>> rows_;
  const Eigen::Vector3d* box_rays_ = nullptr;
  std::map<int, SizeData> sizes_;
};

}  // namespace glovebench
