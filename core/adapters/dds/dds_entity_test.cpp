#include "core/adapters/dds/dds_entity.h"

#include <arpa/inet.h>
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "core/adapters/dds/server/test_messages.h"
#include "core/adapters/dds/test_peers.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

using testing::ElementsAre;

constexpr const char* kTopic = "rt/test";

/// Two ends of a bus that know each other over the network alone.
class DdsEntity : public testing::Test {
 protected:
  void SetUp() override { use_loopback_dds(kFarDomain); }

  template <typename Message>
  static void expect_connected(DdsReader<Message>& reader, const DdsWriter<Message>& writer) {
    ASSERT_TRUE(comes_true([&] { return writer.listeners() == 1 && reader.senders().present().size() == 1; }));
  }
  template <typename Message>
  static std::optional<Message> next(DdsReader<Message>& reader) {
    std::optional<Message> message;
    comes_true([&] {
      const auto received = reader.take([](uint64_t) { return true; });
      if (received) message = received->message;
      return message.has_value();
    });
    return message;
  }
};

TEST_F(DdsEntity, MessagesComeAsTheyWere) {
  const DdsParticipant here(kDomain), there(kFar);
  {
    DdsReader<ros::JointTrajectory> reader(here, kTopic);
    const DdsWriter<ros::JointTrajectory> writer(there, kTopic);
    expect_connected(reader, writer);
    const ros::JointTrajectory sent{
        {7, 8}, "frame", {"a", "", "c"}, {{{1.5, -2}, {3, 4}}, {{}, {0, 0}}, {{1e300}, {1, 999'999'999}}}};
    writer.write(sent, 5);
    const auto got = next(reader);
    ASSERT_TRUE(got);
    EXPECT_EQ(nanoseconds(got->stamp), nanoseconds(sent.stamp));
    EXPECT_EQ(got->frame_id, "frame");
    EXPECT_EQ(got->joint_names, sent.joint_names);
    ASSERT_EQ(got->points.size(), 3U);
    for (size_t p = 0; p < 3; ++p) {
      EXPECT_EQ(got->points[p].positions, sent.points[p].positions);
      EXPECT_EQ(nanoseconds(got->points[p].time_from_start), nanoseconds(sent.points[p].time_from_start));
    }
  }
  {
    DdsReader<ros::PoseStamped> reader(here, "rt/test_pose");
    const DdsWriter<ros::PoseStamped> writer(there, "rt/test_pose");
    expect_connected(reader, writer);
    writer.write({{7, 8}, "base", 1, 2, 3, 4, 5, 6, 7}, 5);
    const auto got = next(reader);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->frame_id, "base");
    EXPECT_THAT((std::array{got->x, got->y, got->z, got->qx, got->qy, got->qz, got->qw}),
                ElementsAre(1, 2, 3, 4, 5, 6, 7));
  }
  {
    DdsReader<ros::JointState> reader(here, "rt/test_state");
    const DdsWriter<ros::JointState> writer(there, "rt/test_state");
    expect_connected(reader, writer);
    writer.write({{7, 8}, {"a", "b"}, {1, 2}, {3}}, 5);
    const auto got = next(reader);
    ASSERT_TRUE(got);
    EXPECT_THAT(got->name, ElementsAre("a", "b"));
    EXPECT_THAT(got->position, ElementsAre(1, 2));
    EXPECT_THAT(got->velocity, ElementsAre(3));
  }
}

TEST_F(DdsEntity, WhatIsTooLargeIsDroppedAndCounted) {
  const UnboundedWriter hostile(kTopic);
  const DdsParticipant here(kDomain);
  DdsReader<ros::JointTrajectory> reader(here, kTopic);
  ASSERT_TRUE(comes_true([&] { return hostile.listeners() == 1 && reader.senders().present().size() == 1; }));
  const int64_t before = dds_messages_too_large();
  const auto named = [](size_t length) { return ros::JointTrajectory{{}, "", {std::string(length, 'x')}, {}}; };
  hostile.write(named(kLargestMessage));
  hostile.write(named(10'000'000));
  hostile.write({{}, "", {}, std::vector<ros::JointTrajectoryPoint>(100'000)});
  hostile.write(named(kLargestMessage - 100));
  const auto got = next(reader);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->joint_names.at(0).size(), size_t{kLargestMessage - 100}) << "the only one that came";
  EXPECT_GE(dds_messages_too_large() - before, 3);
}

TEST_F(DdsEntity, AReaderKeepsNoMoreThanItShall) {
  constexpr int kKept = 5;
  const DdsParticipant here(kDomain), there(kFar);
  DdsReader<ros::JointTrajectory> reader(here, kTopic, kKept);
  const DdsWriter<ros::JointTrajectory> writer(there, kTopic);
  expect_connected(reader, writer);
  const auto waiting = [&] {
    std::array<ddsi_serdata*, 100> messages{};
    std::array<dds_sample_info_t, 100> infos;
    const int count = dds_readcdr(reader.entity(), messages.data(), 100, infos.data(), DDS_ANY_STATE);
    for (int i = 0; i < count; ++i) ddsi_serdata_unref(messages[static_cast<size_t>(i)]);
    return count;
  };
  for (int i = 0; i < 50; ++i) {
    writer.write({{}, "", {std::to_string(i)}, {}}, 1 + i);
    EXPECT_LE(waiting(), kKept);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(comes_true([&] { return waiting() == kKept; }));
  // The first may come before the writer knows the reader; what came first stays, in its order.
  const int first = std::stoi(next(reader).value().joint_names.at(0));
  EXPECT_LT(first, 25);
  for (int i = 1; i < kKept; ++i) EXPECT_EQ(next(reader).value().joint_names.at(0), std::to_string(first + i));
  EXPECT_TRUE(next(reader)) << "and takes more when there is room";
}

TEST_F(DdsEntity, OthersAreAllButOneself) {
  const DdsParticipant here(kDomain), there(kFar);
  auto states = DdsReader<ros::JointState>::of_others(here, kTopic);
  const DdsWriter<ros::JointState> own(here, kTopic), foreign(there, kTopic);
  ASSERT_TRUE(comes_true([&] { return foreign.listeners() == 1 && states.senders().present().size() == 1; }));
  own.write({{}, {"own"}, {}, {}}, 1);
  foreign.write({{}, {"foreign"}, {}, {}}, 1);
  EXPECT_THAT(next(states).value().name, ElementsAre("foreign"));
  EXPECT_FALSE(states.take([](uint64_t) { return true; }));
}

TEST_F(DdsEntity, WritersBeyondABoundAreNotRead) {
  constexpr size_t kTooMany = 20;
  const DdsParticipant here(kDomain), there(kFar), last(kFar);
  auto leaving = std::make_unique<DdsParticipant>(kFar);
  DdsReader<ros::JointState> reader(here, kTopic);
  using Writer = DdsWriter<ros::JointState>;
  std::vector<Writer> crowd = {Writer(*leaving, kTopic)};
  while (crowd.size() < kMostWriters + kTooMany) crowd.emplace_back(there, kTopic);
  const auto read = [&](const Writer& writer) {  // whether its message is, after all that came before
    writer.write({{}, {"a"}, {}, {}}, 1);
    EXPECT_TRUE(writer.wait_for_listeners(10));
    bool is_read = false;
    while (const auto received = reader.take([](uint64_t) { return true; }))
      is_read = received->message.has_value();
    return is_read;
  };
  const int64_t before = dds_messages_of_too_many();
  for (size_t i = 0; i < kMostWriters; ++i) EXPECT_TRUE(comes_true([&] { return read(crowd[i]); }));
  EXPECT_EQ(dds_messages_of_too_many(), before);
  const auto counted = [&] { return dds_messages_of_too_many() > before; };
  for (size_t i = kMostWriters; i < crowd.size(); ++i) EXPECT_FALSE(read(crowd[i]));
  EXPECT_TRUE(comes_true([&] { return !read(crowd.back()) && counted(); }));
  EXPECT_TRUE(read(crowd[1])) << "who was known before is read on";
  EXPECT_EQ(reader.senders().present().size(), 2U);

  leaving.reset();
  const Writer next(last, kTopic);
  EXPECT_TRUE(comes_true([&] {
    reader.senders().present();
    return read(next);
  })) << "there is room again";
  EXPECT_EQ(reader.senders().present().size(), 2U);
}

/// The addresses of this host that UDP sockets of this process are bound to.
std::set<std::string> bound_addresses() {
  std::set<std::string> addresses;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    sockaddr_in address = {};
    socklen_t size = sizeof address;
    const int socket = std::stoi(entry.path().filename());
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 && address.sin_family == AF_INET)
      addresses.insert(inet_ntoa(address.sin_addr));
  }
  return addresses;
}

TEST_F(DdsEntity, TalksOnLoopbackUnlessItIsToldOtherwise) {
  constexpr int kDefault = 200;  // this process keeps to nobody's configuration there
  const std::string configured = getenv("CYCLONEDDS_URI");
  unsetenv("CYCLONEDDS_URI");
  {
    const DdsParticipant participant(kDefault);
    EXPECT_THAT(bound_addresses(), ElementsAre("0.0.0.0", "127.0.0.1")) << "it receives on all, and sends on one";
    EXPECT_THROW(DdsParticipant(kDefault, {.interface = "lo", .security = {}, .role = {}}), Error) << "two ways";
  }
  EXPECT_NO_THROW(DdsParticipant(kDefault, {.interface = "lo", .security = {}, .role = {}}));
  for (const char* wrong : {"none0", "lo\"/>", "a name that is far too long for an interface"})
    EXPECT_THROW(DdsParticipant(kDefault, {.interface = wrong, .security = {}, .role = {}}), Error);
  setenv("CYCLONEDDS_URI", configured.c_str(), 1);
  EXPECT_THROW(DdsParticipant(kDefault, {.interface = "lo", .security = {}, .role = {}}), Error)
      << "beside the URI";
  EXPECT_NO_THROW(DdsParticipant{kDefault});
}

TEST_F(DdsEntity, ADomainEndsWithItsLastParticipant) {
  for (int i = 0; i < 2; ++i) {
    const auto first = std::make_unique<DdsParticipant>(kDomain);
    auto second = std::make_unique<DdsParticipant>(kDomain);
    DdsReader<ros::JointState> reader(*first, kTopic);
    second.reset();
    EXPECT_EQ(reader.senders().present().size(), 0U) << "what is left is alive";
  }
  EXPECT_THROW(DdsParticipant(-1), Error);
  EXPECT_THROW(DdsParticipant(231), Error);
}

}  // namespace
}  // namespace glovebench
