#include "core/kinect/latest_queue.h"

#include <gtest/gtest.h>

namespace glovebench {
namespace {

LatestQueue<int> filled(int count) {
  LatestQueue<int> queue(2);
  EXPECT_FALSE(queue.pop()) << "asked for, and not there yet";
  for (int i = 1; i <= count; ++i) {
    queue.push(i);
    queue.drop_oldest();
  }
  return queue;
}

TEST(LatestQueue, GivesInOrderWhatItHasRoomFor) {
  LatestQueue<int> queue = filled(2);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_FALSE(queue.pop());
  EXPECT_EQ(queue.late(), 0);
}

TEST(LatestQueue, DropsAndCountsTheOldest) {
  LatestQueue<int> queue = filled(7);
  EXPECT_EQ(queue.late(), 5);
  EXPECT_EQ(queue.pop(), 6);
  EXPECT_EQ(queue.pop(), 7);
  EXPECT_TRUE(queue.empty());
}

TEST(LatestQueue, CountsNothingBeforeAnybodyAsked) {
  LatestQueue<int> queue(1);
  for (int i = 1; i <= 4; ++i) {
    queue.push(i);
    queue.drop_oldest();
  }
  EXPECT_EQ(queue.late(), 0);
  EXPECT_EQ(queue.pop(), 4);
}

TEST(LatestQueue, KeepsEverythingForASenderThatWaits) {
  LatestQueue<int> queue(1);
  queue.push(1);
  EXPECT_FALSE(queue.is_overfull());
  queue.push(2);
  EXPECT_TRUE(queue.is_overfull()) << "the sender waits";
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_FALSE(queue.is_overfull());
  EXPECT_EQ(queue.late(), 0);
}

}  // namespace
}  // namespace glovebench
