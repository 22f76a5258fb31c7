#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/dds_types.h"

/// Thin owners of Cyclone DDS's entities. Everything that the library refuses is an Error.
namespace glovebench {

/// Throws Error unless `result` is no error of Cyclone DDS; returns it.
dds_entity_t checked_dds(dds_entity_t result, const std::string& what, const std::string& expected);

/// What anybody on the network can make a process keep: messages of at most that size, each reader that many of
/// them. One for the hand has a thousand bytes. What is larger, the library drops at its first fragment.
inline constexpr int kLargestMessage = 16 << 10;  // bytes, on the wire
inline constexpr int kMaxWaiting = 10'000;        // a flood of 0.1 s: who has to wait longer loses what it sent

/// Messages that a writer keeps for its readers, as in ROS 2.
inline constexpr int kRosDepth = 10;

/// Larger messages that were dropped since the process began.
int64_t dds_messages_too_large();

struct DdsDomain;

/// A participant in a domain. With it go all entities that were made with it.
class DdsParticipant {
 public:
  /// Limits the size of messages, and the library's own lines on stderr. Throws Error: a domain that is not 0 to
  /// 230, no such interface, an interface although CYCLONEDDS_URI is set, or another access than that of this
  /// process's participants in the domain.
  explicit DdsParticipant(int domain, const DdsAccess& access = {});
  ~DdsParticipant() { dds_delete(entity_); }
  DdsParticipant(const DdsParticipant&) = delete;
  DdsParticipant& operator=(const DdsParticipant&) = delete;
  dds_entity_t entity() const { return entity_; }

  dds_entity_t make_topic(const dds_topic_descriptor_t& type, const std::string& name) const;
  /// As ROS 2 does by default: reliable, volatile, the last ten.
  dds_entity_t make_writer(dds_entity_t topic) const;
  /// Reliable, volatile, up to `max_waiting` until they are taken; then the senders wait. The last ten would do for
  /// one sender, but a flood by one must not push out what another has sent.
  dds_entity_t make_reader(dds_entity_t topic, int max_waiting) const;
  /// The last `depth` that other participants have sent.
  dds_entity_t make_reader_of_others(dds_entity_t topic, int depth) const;

 private:
  std::shared_ptr<const DdsDomain> domain_;
  dds_entity_t entity_;
};

template <typename Message>
class DdsWriter {
 public:
  DdsWriter(const DdsParticipant& participant, const std::string& topic)
      : topic_(topic),
        writer_(participant.make_writer(participant.make_topic(DdsType<Message>::descriptor(), topic))) {}

  /// `source_ns`: when what the message tells began, ns since 1970; others see it as its source time.
  void write(const Message& message, int64_t source_ns) const {
    checked_dds(DdsType<Message>::write(writer_, message, source_ns), topic_, "a message to be sent");
  }
  /// Until all that listen now have everything, but no longer than `timeout_s`. False if they have not.
  bool wait_for_listeners(double timeout_s) const {
    return dds_wait_for_acks(writer_, static_cast<dds_duration_t>(timeout_s * 1e9)) == DDS_RETCODE_OK;
  }
  int listeners() const {
    dds_publication_matched_status_t status = {};
    dds_get_publication_matched_status(writer_, &status);
    return static_cast<int>(status.current_count);
  }

 private:
  std::string topic_;
  dds_entity_t writer_;
};

/// Watches for writers of other participants on some topics, of which only one may write.
class DdsOtherWriters {
 public:
  /// Looks for a second, long enough for whoever the middleware finds. Throws Error as `refuse`.
  DdsOtherWriters(const DdsParticipant& participant, std::vector<std::string> topics);
  /// Throws Error if there is such a writer now.
  void refuse();

 private:
  dds_domainid_t domain_ = 0;
  std::vector<std::string> topics_;
  dds_instance_handle_t own_ = 0;
  dds_entity_t publications_;
  std::map<dds_instance_handle_t, std::string> writers_;  ///< others, with their topics
};

/// Writers that a reader tells apart. What further ones send is not read: peers without end take neither time nor
/// memory here (the library itself keeps each that it knows).
inline constexpr size_t kMostWriters = 64;

/// Messages that were not read because their writer was one too many, since the process began.
int64_t dds_messages_of_too_many();

/// Tells writers of a reader's messages apart by the process they belong to.
class DdsSenders {
 public:
  explicit DdsSenders(dds_entity_t reader) : reader_(reader) {}
  /// The participant that a message's writer belongs to, also if that has gone meanwhile. Nothing, and counted, if
  /// kMostWriters others have sent something and were there at the last call of `present`.
  std::optional<uint64_t> of(dds_instance_handle_t writer);
  /// The participants of the writers that are there now: of all that have sent something, and of some that have
  /// not.
  std::set<uint64_t> present();

 private:
  /// Nothing if the writer is not there.
  std::optional<uint64_t> look_up(dds_instance_handle_t writer) const;

  dds_entity_t reader_;
  std::unordered_map<dds_instance_handle_t, uint64_t> participants_;  ///< of writers that have sent something
};

template <typename Message>
class DdsReader {
 public:
  struct Received {
    std::optional<Message> message;  ///< empty if it was not wanted, or its writer is one too many
    uint64_t sender = 0;             ///< 0 if its writer is one too many
    int64_t source_ns = 0;
  };

  /// Keeps up to `max_waiting` messages until they are taken; then it makes the senders wait.
  DdsReader(const DdsParticipant& participant, const std::string& topic, int max_waiting = kMaxWaiting)
      : DdsReader(participant.make_reader(make_topic(participant, topic), max_waiting)) {}
  /// Keeps the last `depth` that other participants have sent.
  static DdsReader of_others(const DdsParticipant& participant, const std::string& topic, int depth = kRosDepth) {
    return DdsReader(participant.make_reader_of_others(make_topic(participant, topic), depth));
  }

  dds_entity_t entity() const { return reader_; }
  DdsSenders& senders() { return senders_; }

  /// The next message, if there is one. It is read if `is_wanted(sender)`: a flood of others costs little.
  template <typename IsWanted>
  std::optional<Received> take(const IsWanted& is_wanted) {
    for (;;) {
      void* sample = nullptr;
      dds_sample_info_t info;
      const dds_return_t count = dds_take(reader_, &sample, &info, 1, 1);
      if (count <= 0) return std::nullopt;
      std::optional<Received> received;
      if (info.valid_data) {
        const std::optional<uint64_t> sender = senders_.of(info.publication_handle);
        received = Received{std::nullopt, sender.value_or(0), info.source_timestamp};
        if (sender && is_wanted(*sender)) received->message = DdsType<Message>::read(sample);
      }
      dds_return_loan(reader_, &sample, count);
      if (received) return received;
    }
  }

 private:
  explicit DdsReader(dds_entity_t reader) : reader_(reader), senders_(reader) {}
  static dds_entity_t make_topic(const DdsParticipant& participant, const std::string& topic) {
    return participant.make_topic(DdsType<Message>::descriptor(), topic);
  }

  dds_entity_t reader_;
  DdsSenders senders_;
};

/// Waits until one of some readers has something.
class DdsWaitset {
 public:
  explicit DdsWaitset(const DdsParticipant& participant);
  void add(dds_entity_t reader);
  void wait(int64_t timeout_ns) const;

 private:
  dds_entity_t waitset_;
};

}  // namespace glovebench
