#pragma once

#include <memory>
#include <string>

#include "core/base/image.h"
#include "core/database/view_sphere.h"

namespace glovebench::render {

/// Draws front faces from 0.05 to 10 m. For one thread at a time.
class LabelRenderer : public ViewRenderer {
 public:
  /// Throws: Error without OpenGL.
  LabelRenderer();
  ~LabelRenderer() override;

  LabelImage render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                           const Eigen::Isometry3d& T_camera_hand) override;
  HandImages render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                        const Eigen::Isometry3d& T_camera_hand) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

ViewRendererFactory label_renderer_factory();
/// Hash of the sources that determine a database (ci/source_hash.cmake).
std::string database_source_hash();

}  // namespace glovebench::render
