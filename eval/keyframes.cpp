#include "eval/keyframes.h"

#include "core/base/error.h"
#include "render/label_renderer.h"
#include "render/pictures.h"
#include "render/rgbd_renderer.h"

namespace glovebench::eval {
namespace {

using reports::Estimate;
using reports::FrameSheet;

constexpr int kColumns = 16;
// Multiples of 16, since a JPEG shares colors in blocks of 16 x 16 px and tiles must not share any.
constexpr int kTileWidth = 240, kTileHeight = 192;
constexpr int kKeyframeQuality = 80;

/// Bounding box of the hand in the image, with a margin.
Eigen::AlignedBox2d box_of_hand(const PinholeCamera& camera, const HandModel& hand,
                                std::span<const HandFrame> frames) {
  Eigen::AlignedBox2d box;
  for (const HandFrame& frame : frames) {
    for (const Eigen::Vector3f& p_hand : hand.pose(frame.posture).vertices)
      box.extend(camera.project(frame.T_camera_hand * p_hand.cast<double>()));
  }
  constexpr double kMargin = 0.08;  // of the box, so that an estimate beside the truth is visible
  const Eigen::Vector2d margin = kMargin * box.sizes();
  return {box.min() - margin, box.max() + margin};
}

void paste(ColorImage& sheet, const ColorImage& tile, int column, int row) {
  for (int v = 0; v < tile.height(); ++v) {
    const int left = column * tile.width(), top = row * tile.height() + v;
    std::copy_n(tile.data() + static_cast<ptrdiff_t>(v) * tile.width(), tile.width(),
                sheet.data() + static_cast<ptrdiff_t>(top) * sheet.width() + left);
  }
}

class TilePainter {
 public:
  TilePainter(std::shared_ptr<const HandModel> hand, const PinholeCamera& camera)
      : hand_(std::move(hand)), camera_(camera), color_({camera, camera}, hand_, {}) {}

  ColorImage truth(const HandFrame& frame) {
    return color_.render(hand_->pose(frame.posture), frame.T_camera_hand, {}).color;
  }
  ColorImage difference(const HandFrame& frame, const Estimate& estimate) {
    const DepthImage truth = depth(frame.posture, frame.T_camera_hand);
    const DepthImage estimated = estimate.status == TrackStatus::tracked
                                     ? depth(estimate.posture, estimate.T_camera_hand)
                                     : DepthImage(camera_.width, camera_.height);
    return render::picture_of_depth_difference(truth, estimated, reports::kSheetDifferenceMm / 1000);
  }

 private:
  DepthImage depth(const Posture& posture, const Eigen::Isometry3d& T_camera_hand) {
    return ids_.render_ids(*hand_, hand_->pose(posture), camera_, T_camera_hand).depth;
  }

  std::shared_ptr<const HandModel> hand_;
  PinholeCamera camera_;
  render::RgbdRenderer color_;
  render::LabelRenderer ids_;
};

}  // namespace

PinholeCamera camera_around(const PinholeCamera& ir, const HandModel& hand, std::span<const HandFrame> frames,
                            int tile_width, int tile_height) {
  check(!frames.empty(), "a window is around the hand of some frame");
  const Eigen::AlignedBox2d box = box_of_hand(ir, hand, frames);
  const double scale = std::min(tile_width / box.sizes().x(), tile_height / box.sizes().y());
  // Pixel centers have integer coordinates, so a tile's middle is at (width - 1) / 2.
  return {tile_width,
          tile_height,
          ir.fx * scale,
          ir.fy * scale,
          (ir.cx - box.center().x()) * scale + (tile_width - 1) / 2.0,
          (ir.cy - box.center().y()) * scale + (tile_height - 1) / 2.0};
}

FrameSheet make_frame_sheet(Workbench& workbench, const std::string& figure, std::span<const HandFrame> frames,
                            std::span<const Estimate> estimates) {
  check(frames.size() == estimates.size(), "a sheet has an estimate for each frame");
  // Recorded truths are of subject 1, whose hand is the tracker's.
  const std::shared_ptr<const HandModel> hand = workbench.model();
  TilePainter painter(hand, camera_around(workbench.calibration().ir, *hand, frames, kTileWidth, kTileHeight));
  const auto count = static_cast<int>(frames.size());
  const int rows = (count + kColumns - 1) / kColumns;
  ColorImage sheet(kColumns * kTileWidth, 2 * rows * kTileHeight);
  for (int i = 0; i < count; ++i) {
    paste(sheet, painter.truth(frames[i]), i % kColumns, 2 * (i / kColumns));
    paste(sheet, painter.difference(frames[i], estimates[i]), i % kColumns, 2 * (i / kColumns) + 1);
  }
  return {figure,      render::encode_jpeg(sheet, kKeyframeQuality),
          kColumns,    kTileWidth,
          kTileHeight, estimates.front().frame,
          count};
}

}  // namespace glovebench::eval
