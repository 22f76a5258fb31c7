#include "eval/pictures.h"

#include <gtest/gtest.h>

#include "core/adapters/pictures/picture_files.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using reports::Estimate;

std::vector<HandFrame> make_frames() {
  return trajectories::parse_trajectory(make_trajectory_json("three", 3).dump(), "test").frames;
}

Estimate estimate_of(const HandFrame& frame, int number) {
  return {1, number, frame.timestamp_us, TrackStatus::tracked, frame.posture, frame.T_camera_hand};
}

TEST(Keyframes, WindowHoldsTheHandOfEveryFrameAndSeesWhatTheCameraSees) {
  Workbench workbench(test_workbench(1));
  const std::vector<HandFrame> frames = make_frames();
  const PinholeCamera ir = workbench.calibration().ir;
  const PinholeCamera tile = camera_around(ir, *workbench.model(), frames, 160, 128);
  EXPECT_EQ(tile.width, 160);
  EXPECT_EQ(tile.height, 128);
  EXPECT_DOUBLE_EQ(tile.fx / tile.fy, ir.fx / ir.fy) << "pixels keep their shape";
  Eigen::AlignedBox2d seen;
  for (const HandFrame& frame : frames)
    for (const Eigen::Vector3f& p_hand : workbench.model()->pose(frame.posture).vertices)
      seen.extend(tile.project(frame.T_camera_hand * p_hand.cast<double>()));
  EXPECT_GT(seen.min().minCoeff(), -0.5);
  EXPECT_LT(seen.max().x(), 159.5);
  EXPECT_LT(seen.max().y(), 127.5);
  EXPECT_GT(std::max(seen.sizes().x() / 160, seen.sizes().y() / 128), 0.8) << "and is not mostly empty";
}

/// The sheet's pixel in the middle of the glove in frame `i`, in its truth (row 0) or difference (row 1).
Rgb pixel_at(const ColorImage& sheet, const reports::FrameSheet& description, int i, int row,
             const Eigen::Vector2d& uv) {
  const int left = i % description.columns * description.tile_width;
  const int top = (2 * (i / description.columns) + row) * description.tile_height;
  return sheet(left + static_cast<int>(std::lround(uv.x())), top + static_cast<int>(std::lround(uv.y())));
}

TEST(Keyframes, DifferenceIsWhiteForTheTruthOrangeBehindItAndGrayWhereLost) {
  Workbench workbench(test_workbench(1));
  const std::vector<HandFrame> frames = make_frames();
  std::vector<Estimate> estimates;
  for (int i = 0; i < 3; ++i) estimates.push_back(estimate_of(frames[i], i + 5));
  estimates[1].T_camera_hand.translation().z() += 0.03;
  estimates[2].status = TrackStatus::no_hand;
  const reports::FrameSheet sheet = make_frame_sheet(workbench, "figure5", frames, estimates);
  EXPECT_EQ(sheet.figure, "figure5");
  EXPECT_EQ(sheet.first_frame, 5);
  EXPECT_EQ(sheet.frames, 3);
  const ColorImage image = decode_color(sheet.image, "sheet");
  ASSERT_EQ(image.width(), sheet.columns * sheet.tile_width);
  ASSERT_EQ(image.height(), 2 * sheet.tile_height);

  const PinholeCamera tile =
      camera_around(workbench.calibration().ir, *workbench.model(), frames, sheet.tile_width, sheet.tile_height);
  const auto difference = [&](int i) {
    return pixel_at(image, sheet, i, 1, tile.project(frames[i].T_camera_hand.translation()));
  };
  constexpr int kJpegError = 12;  // of a channel, in a surface of one color
  EXPECT_GT(difference(0)[2], 247 - kJpegError);
  EXPECT_NEAR(difference(1)[0], 178, kJpegError);
  EXPECT_NEAR(difference(1)[2], 10, kJpegError) << "30 mm behind the truth is beyond the range";
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(difference(2)[channel], 128, kJpegError);
}

}  // namespace
}  // namespace glovebench::eval
