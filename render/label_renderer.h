#pragma once

#include <memory>
#include <string>

#include "core/base/image.h"
#include "core/database/view_sphere.h"

namespace glovebench::render {

/// What a camera sees of the hand alone, at each pixel's center.
struct HandImages {
  LabelImage label;      ///< 1..kColorCount, 0 where there is no hand
  Image<uint8_t> patch;  ///< patch + 1, 0 where there is no hand
  DepthImage depth;      ///< z, m, 0 where there is no hand
};

/// Draws the hand's labels with OpenGL. Surfaces between 0.05 and 10 m are drawn, back faces are not. An object
/// serves one thread at a time.
class LabelRenderer : public ViewRenderer {
 public:
  /// Throws Error if no OpenGL context can be had.
  LabelRenderer();
  ~LabelRenderer() override;

  LabelImage render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                           const Eigen::Isometry3d& T_camera_hand) override;
  /// Labels, patches and metric depth at once.
  HandImages render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                        const Eigen::Isometry3d& T_camera_hand);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// For `Database::build`.
ViewRendererFactory label_renderer_factory();
/// For `DatabaseCache`: hash of the sources that decide what a database holds of its inputs (ci/source_hash.cmake).
std::string database_source_hash();

}  // namespace glovebench::render
