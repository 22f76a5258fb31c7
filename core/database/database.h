#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/database/distance_field.h"
#include "core/database/field_rows.h"
#include "core/database/tiny_image.h"
#include "core/database/view_renderer.h"
#include "core/database/view_sphere.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// Postures of one database, e.g. "DB_open_power".
struct PostureSet {
  std::string name;
  std::vector<std::string> posture_names;
  std::vector<Posture> postures;
};

/// How the views of a posture are rendered.
struct ViewConfig {
  double distance = 0.75;           ///< camera to hand origin, m
  double field_of_view_deg = 24.0;  ///< of the square image
  int image_size = 192;             ///< px
  double field_cap_share = 0.5;  ///< largest distance, also that of an absent color, as a share of the side, (0, 1]
};

/// The image database of section III: 756 views of each posture, as tiny images of several sizes with one
/// distance field a color. Entry = posture * 756 + view. Immutable, shared between threads.
class Database {
 public:
  /// Renders all views; the renderer factory is called once a thread. The result does not depend on `threads`.
  /// `progress`, if given, hears the share done (0..1). `sizes` are the tiny images' edge lengths, 4..64 px; what
  /// is stored of one does not depend on the others, nor does `hash()`. Throws Error for another size, a size named
  /// twice or no postures.
  static Database build(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                        const ViewRendererFactory& renderers, int threads,
                        const std::function<void(double)>& progress = {}, std::span<const int> sizes = kTinySizes);

  /// Versioned, checksummed file. `load` throws Error naming the file and what is wrong with it; `sizes` are the
  /// tiny-image sizes whose fields are wanted. Uses the threads of the caller's TBB arena.
  void save(const std::string& path) const;
  static Database load(const std::string& path, std::span<const int> sizes = kTinySizes);
  /// What a database made of these inputs would have as `hash()`.
  static std::string input_hash(const PostureSet& postures, const HandModel& model, const ViewConfig& views);

  int entry_count() const { return static_cast<int>(postures_.postures.size()) * kViewCount; }
  const PostureSet& posture_set() const { return postures_; }
  const Posture& posture(int entry) const { return postures_.postures[entry / kViewCount]; }
  static int view(int entry) { return entry % kViewCount; }
  /// Direction, in the view's camera, from the camera to the center of the hand's bounding square.
  const Eigen::Vector3d& box_ray(int entry) const { return box_rays_[entry]; }
  Side side() const { return side_; }
  /// Hash of all inputs.
  const std::string& hash() const { return hash_; }

  /// Labels of one entry, size*size. Throws Error if that size was not loaded.
  const uint8_t* labels(int size, int entry) const;
  /// Distance fields of one entry: kColorCount fields of size*size, in steps of 1/kFieldScale px, chamfer metric,
  /// capped at the view configuration's cap.
  const uint8_t* fields(int size, int entry) const;
  /// The same fields, arranged for a look at all entries at once. Throws Error as `labels` does.
  const FieldRows& field_rows(int size) const { return data(size).rows; }
  bool has_size(int size) const { return sizes_.contains(size); }

 private:
  struct SizeData {
    std::vector<uint8_t> labels;  ///< [entry][pixel]
    AlignedBytes fields;          ///< [entry][color][pixel], and kBehind bytes
    FieldRows rows;
  };
  /// What look-ups may read behind the last field, bytes.
  static constexpr size_t kBehind = 64;

  const SizeData& data(int size) const;
  /// To be called when the fields are complete.
  void arrange_rows();

  PostureSet postures_;
  Side side_ = Side::right;
  std::string hash_;
  std::vector<Eigen::Vector3d> box_rays_;
  std::map<int, SizeData> sizes_;
};

}  // namespace glovebench
