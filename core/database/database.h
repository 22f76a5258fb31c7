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
#include "core/database/tiny_image.h"
#include "core/database/view_sphere.h"
#include "core/hand/hand_model.h"
#include "core/hand/posture.h"

namespace glovebench {

struct ViewConfig {
  double distance = 0.75;           ///< camera to hand origin, m
  double field_of_view_deg = 24.0;  ///< of the square image
  int image_size = 192;             ///< px
  double field_cap_share = 0.5;     ///< largest stored distance / side, (0, 1]
};

/// In 1/kFieldScale px.
uint8_t field_cap(double cap_share, int size);

/// 756 views of each posture as tiny images, with a distance field per color. Immutable; copies share memory.
/// Paper: section III.
class Database {
 public:
  /// `threads` do not change the result. Each thread calls `renderers` once. `progress` gets 0 to 1.
  /// Throws: Error without postures, or for a repeated size or one outside 4..64 px.
  static Database build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                        const ViewRendererFactory& renderers, int threads,
                        const std::function<void(double)>& progress = {}, std::span<const int> sizes = kTinySizes,
                        DatabaseMemory memory = DatabaseMemory::normal);
  /// Builds a file, even beyond memory. Returns its `content_hash()`.
  /// Throws: Error as `build`, or if the disk is full.
  static std::string build_file(const std::string& path, const PostureSet& postures, const HandModel& model,
                                const ViewConfig& views, const ViewRendererFactory& renderers, int threads,
                                const std::function<void(double)>& progress = {},
                                std::span<const int> sizes = kTinySizes,
                                DatabaseMemory memory = DatabaseMemory::normal);

  void save(const std::string& path) const;
  /// Loads those of `sizes` that exist. Checks hashes and values. Labels and fields stay mapped
  /// (MappedMemory::of_file). Uses the caller's TBB arena.
  /// Throws: Error.
  static Database load(const std::string& path, std::span<const int> sizes = kTinySizes);
  /// Recomputes loaded fields in the caller's TBB arena.
  /// Throws: Error if a stored one differs.
  void check() const;
  /// Throws: Error if the file changed since.
  void require_unchanged() const { bytes_->require_unchanged(); }
  static std::string input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views);

  int entry_count() const { return static_cast<int>(header_.postures.postures.size()) * kViewCount; }
  const PostureSet& posture_set() const { return header_.postures; }
  const Posture& posture(int entry) const { return header_.postures.postures[entry / kViewCount]; }
  static int view(int entry) { return entry % kViewCount; }
  /// Unit vector from the view's camera to the hand's bounding square's center.
  const Eigen::Vector3d& box_ray(int entry) const { return box_rays_[entry]; }
  Side side() const { return header_.side; }
  /// Hash of the inputs, without the memory mode.
  const std::string& input_hash() const { return header_.input_hash; }
  /// See DatabaseLayout.
  const std::string& content_hash() const { return content_hash_; }
  DatabaseMemory memory() const { return header_.memory; }

  /// Throws: Error if the size is not loaded.
  LabelImage labels(int size, int entry) const;
  /// Chamfer fields, kColorCount * size * size values in 1/kFieldScale px.
  /// Throws: Error as `labels`, and in low memory.
  const uint8_t* fields(int size, int entry) const;
  uint8_t field_cap(int size) const { return glovebench::field_cap(header_.field_cap_share, size); }
  /// Throws: Error as `labels`.
  const FieldRows& field_rows(int size) const { return *data(size).rows; }
  bool has_size(int size) const { return sizes_.contains(size); }

 private:
  struct SizeData {
    const uint8_t* labels = nullptr;
    const uint8_t* fields = nullptr;  ///< [entry][color][pixel]; null in low memory
    const FieldRows* rows = nullptr;
  };

  Database(std::shared_ptr<const MappedMemory> bytes, const DatabaseLayout& layout, std::map<int, FieldRows> rows);
  const SizeData& data(int size) const;

  std::shared_ptr<const MappedMemory> bytes_;
  DatabaseHeader header_;
  std::string content_hash_;
  std::shared_ptr<const std::map<int, FieldRows>> rows_;
  const Eigen::Vector3d* box_rays_ = nullptr;
  std::map<int, SizeData> sizes_;
};

}  // namespace glovebench
