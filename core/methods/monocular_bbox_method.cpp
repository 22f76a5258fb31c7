// The paper's look-up from the color image alone: no depth, so no point cloud and no alignment. The size of the
// hand's bounding square tells how far away the hand is.

#include <opencv2/imgproc.hpp>

#include "core/methods/method.h"
#include "core/pose/box_placement.h"
#include "core/tracker/sighting.h"
#include "core/tracker/smoothing.h"
#include "core/tracker/tracker.h"

namespace glovebench {
namespace {

struct Blob {
  LabelImage labels;  ///< 0 outside the component
  int pixels = 0;
};

/// The largest connected component (8-neighborhood) of labeled pixels; of equally large ones the first.
Blob largest_blob(LabelImage labels) {
  const cv::Mat view(labels.height(), labels.width(), CV_8U, labels.data());
  cv::Mat components, statistics, centers;
  const int count = cv::connectedComponentsWithStats(view, components, statistics, centers, 8, CV_32S);
  Blob blob;
  int largest = 0;  // the background
  for (int component = 1; component < count; ++component) {
    const int pixels = statistics.at<int>(component, cv::CC_STAT_AREA);
    if (pixels <= blob.pixels) continue;
    blob.pixels = pixels;
    largest = component;
  }
  for (int v = 0; v < labels.height(); ++v) {
    for (int u = 0; u < labels.width(); ++u)
      if (components.at<int>(v, u) != largest) labels(u, v) = 0;
  }
  blob.labels = std::move(labels);
  return blob;
}

class MonocularBbox : public Method {
 public:
  explicit MonocularBbox(const MethodInputs& inputs) : in_(inputs) {
    check_inputs(in_.config, *in_.model, *in_.database, *in_.table);
  }

  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                    const StageObserver& observe) override {
    TrackResult result = estimate(frame.color, observe);
    result.timestamp_us = frame.depth_timestamp_us;
    observe(Stage::smoothing);
    return smoothed(std::move(result), previous, in_.config.smoothing);
  }

 private:
  TrackResult estimate(const ColorImage& color, const StageObserver& observe) const;

  MethodInputs in_;
};

TrackResult MonocularBbox::estimate(const ColorImage& color, const StageObserver& observe) const {
  TrackResult result;
  observe(Stage::segmentation);
  LabelImage labels = segment(color, *in_.table);
  if (in_.config.segmentation.majority_filter) labels = majority_filter(labels);

  observe(Stage::detection);
  const Blob blob = largest_blob(std::move(labels));
  if (blob.pixels < in_.config.detection.min_pixels) return result.status = TrackStatus::no_hand, result;
  if (is_cut_by_border(blob.labels, blob.pixels, in_.config.detection))
    return result.status = TrackStatus::cut_by_border, result;

  HandLookUp found = look_up_hand(blob.labels, in_.calibration.rgb, *in_.database, in_.config.lookup, observe);
  result.matches = std::move(found.matches);
  result.status = found.status;
  if (result.status != TrackStatus::tracked) return result;
  const CoarseEstimate& coarse = found.coarse;
  result.ambiguous = coarse.ambiguous;
  result.posture_unfiltered = coarse.posture;

  observe(Stage::placement);
  // `R_camera_hand` is in the frame of the camera of the query: here the RGB camera.
  const auto placed = place_in_square(in_.model->pose(coarse.posture).vertices, coarse.R_camera_hand,
                                      image_square(found.square), in_.calibration.rgb);
  if (!placed) return result.status = TrackStatus::poor_alignment, result;
  const Eigen::Isometry3d& T_rgb_hand = placed->T_camera_hand;
  result.T_camera_hand_coarse = in_.calibration.T_rgb_ir.inverse() * T_rgb_hand;
  result.T_camera_hand_unfiltered = result.T_camera_hand_coarse;
  result.converged = placed->converged;
  return result;
}

std::unique_ptr<Method> make_monocular_bbox(const MethodInputs& inputs) {
  return std::make_unique<MonocularBbox>(inputs);
}

}  // namespace

MethodEntry monocular_bbox_method() {
  return {"monocular_bbox", "the color image alone: the paper's look-up, depth from the size of the bounding box",
          make_monocular_bbox, false};
}

}  // namespace glovebench
