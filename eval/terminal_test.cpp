#include "eval/terminal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

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

/// Stdout is a terminal of that width meanwhile.
class TerminalOutput {
 public:
  explicit TerminalOutput(unsigned short columns)
      : stdout_(dup(STDOUT_FILENO)), main_(posix_openpt(O_RDWR | O_NOCTTY)) {
    grantpt(main_);
    unlockpt(main_);
    const int end = open(ptsname(main_), O_RDWR | O_NOCTTY);
    const winsize size{24, columns, 0, 0};
    ioctl(end, TIOCSWINSZ, &size);
    dup2(end, STDOUT_FILENO);
    close(end);
  }
  ~TerminalOutput() {
    dup2(stdout_, STDOUT_FILENO);
    close(stdout_);
    close(main_);
  }
  TerminalOutput(const TerminalOutput&) = delete;
  TerminalOutput& operator=(const TerminalOutput&) = delete;

 private:
  int stdout_, main_;
};

TEST(TerminalColumns, AreTheTerminalsOr80) {
  const auto columns = [](unsigned short width) {
    std::fflush(stdout);
    const TerminalOutput terminal(width);
    return terminal_columns();
  };
  EXPECT_EQ(columns(100), 100U);
  EXPECT_EQ(columns(20), 60U) << "columns of a table need some space";
  EXPECT_EQ(columns(0), 80U) << "a terminal that does not know";
  testing::internal::CaptureStdout();
  EXPECT_EQ(terminal_columns(), 80U) << "a file";
  testing::internal::GetCapturedStdout();
}

/// Ends this process by the second signal, if the first only set the flag.
void raise_both(int first, int second) {
  const Interruption interruption;
  if (Interruption::wished()) std::exit(1);
  std::raise(first);
  if (!Interruption::wished()) std::exit(1);
  std::raise(second);
  std::exit(0);
}

TEST(InterruptionDeathTest, SecondSignalEndsTheProgram) {
  for (int first : {SIGINT, SIGTERM})
    for (int second : {SIGINT, SIGTERM})
      EXPECT_EXIT(raise_both(first, second), testing::KilledBySignal(second), "") << first;
}

TEST(InterruptionDeathTest, AHangUpIsAWishHoweverOftenItComes) {
  EXPECT_EXIT(
      {
        const Interruption interruption;
        for (int i = 0; i < 3; ++i) std::raise(SIGHUP);
        if (!Interruption::wished()) std::exit(1);
        std::raise(SIGINT);
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}

TEST(Interruption, IsAWishOnceAndNoneAfterwards) {
  {
    const Interruption first;
    EXPECT_FALSE(Interruption::wished());
    raise(SIGINT);
    EXPECT_TRUE(Interruption::wished());
  }
  const Interruption second;
  EXPECT_FALSE(Interruption::wished());
}

TEST(Interruption, IgnoresAHangUpThatIsIgnoredAlready) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  {
    const Interruption interruption;
    std::raise(SIGHUP);
    EXPECT_FALSE(Interruption::wished());
  }
  EXPECT_EQ(std::signal(SIGHUP, before), SIG_IGN);
}

}  // namespace

}  // namespace glovebench::eval
