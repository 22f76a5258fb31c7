#include "eval/interruption.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace glovebench::eval {
namespace {

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
