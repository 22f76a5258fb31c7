#include "eval/terminal.h"

#include <gtest/gtest.h>

namespace glovebench::eval {
namespace {

TrackResult result(TrackStatus status, double residual) {
  TrackResult made;
  made.status = status;
  made.icp_residual = residual;
  return made;
}

TEST(LiveStatus, KnowsNothingBeforeTheFirstFrames) {
  LiveStatus status;
  EXPECT_EQ(status.line(0), "- frames/s, -% tracked, residual - mm, 0 dropped");
  status.add(1.0, result(TrackStatus::no_hand, 0));
  EXPECT_EQ(status.line(1), "- frames/s, 0% tracked, residual - mm, 1 dropped");
}

TEST(LiveStatus, CountsRateShareAndResidualOfTrackedFrames) {
  LiveStatus status;
  status.add(10.00, result(TrackStatus::tracked, 0.001));
  status.add(10.05, result(TrackStatus::poor_match, 0.9));
  status.add(10.10, result(TrackStatus::tracked, 0.002));
  status.add(10.15, result(TrackStatus::tracked, 0.003));
  EXPECT_EQ(status.line(4), "20.0 frames/s, 75% tracked, residual 2.0 mm, 4 dropped");
}

TEST(LiveStatus, SpeaksOfTheLastFramesOnly) {
  LiveStatus status;
  status.add(0, result(TrackStatus::no_hand, 0));
  for (size_t f = 0; f < LiveStatus::kFrames; ++f)
    status.add(100 + 0.1 * static_cast<double>(f), result(TrackStatus::tracked, 0.004));
  EXPECT_EQ(status.line(0), "10.0 frames/s, 100% tracked, residual 4.0 mm, 0 dropped");
}

TEST(Progress, TellsALogOnlyOnceItIsAskedTo) {
  const auto said = [](bool quiet) {
    testing::internal::CaptureStderr();
    Progress("working", quiet).show(0.5);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(false), "");
  log_progress(0);
  EXPECT_EQ(said(false), "working: 50%, 0 s left\n");
  EXPECT_EQ(said(true), "");
  log_progress(3600);
  EXPECT_EQ(said(false), "") << "the next line is due in an hour";
}

}  // namespace
}  // namespace glovebench::eval
