#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/dds_types.h"

// Throws: Error, from every function, if Cyclone DDS refuses.
namespace glovebench {

/// Returns `result`.
/// Throws: Error for an error code.
dds_entity_t checked_dds(dds_entity_t result, const std::string& what, const std::string& expected);

/// Limits of the memory that others can fill.
inline constexpr int kLargestMessage = 16 << 10;  // bytes
inline constexpr int kMaxWaiting = 10'000;        // messages in a reader

/// Messages that a writer keeps, as in ROS 2.
inline constexpr int kRosDepth = 10;

/// Messages over kLargestMessage, which this process dropped.
int64_t dds_messages_too_large();

struct DdsDomain;

class DdsParticipant {
 public:
  /// Throws: Error for a domain outside 0..230, an unknown interface, an interface beside CYCLONEDDS_URI, or other
  /// access than the domain already has.
  explicit DdsParticipant(int domain, const DdsAccess& access = {});
  ~DdsParticipant() { dds_delete(entity_); }
  DdsParticipant(const DdsParticipant&) = delete;
  DdsParticipant& operator=(const DdsParticipant&) = delete;
  dds_entity_t entity() const { return entity_; }

  dds_entity_t make_topic(const dds_topic_descriptor_t& type, const std::string& name) const;
  /// Reliable, volatile, as in ROS 2.
  dds_entity_t make_writer(dds_entity_t topic) const;
  /// Senders block while `max_waiting` messages wait.
  dds_entity_t make_reader(dds_entity_t topic, int max_waiting) const;
  /// The last `depth` messages from other participants.
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

  /// `source_ns`: nanoseconds since 1970.
  void write(const Message& message, int64_t source_ns) const {
    checked_dds(DdsType<Message>::write(writer_, message, source_ns), topic_, "a message to be sent");
  }
  /// False if listeners still lack messages.
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

class DdsOtherWriters {
 public:
  /// Searches for 1 s.
  /// Throws: Error as `refuse`.
  DdsOtherWriters(const DdsParticipant& participant, std::vector<std::string> topics);
  /// Throws: Error if another participant writes on the topics.
  void refuse();

 private:
  dds_domainid_t domain_ = 0;
  std::vector<std::string> topics_;
  dds_instance_handle_t own_ = 0;
  dds_entity_t publications_;
  std::map<dds_instance_handle_t, std::string> writers_;
};

/// A reader ignores messages from more writers than this.
inline constexpr size_t kMostWriters = 64;

/// Messages of further writers that this process ignored.
int64_t dds_messages_of_too_many();

class DdsSenders {
 public:
  explicit DdsSenders(dds_entity_t reader) : reader_(reader) {}
  /// The writer's participant, even if gone. Beyond kMostWriters: empty, and counts the message.
  std::optional<uint64_t> of(dds_instance_handle_t writer);
  /// Participants with a writer now.
  std::set<uint64_t> present();

 private:
  std::optional<uint64_t> look_up(dds_instance_handle_t writer) const;

  dds_entity_t reader_;
  std::unordered_map<dds_instance_handle_t, uint64_t> participants_;
};

template <typename Message>
class DdsReader {
 public:
  struct Received {
    std::optional<Message> message;  ///< empty if unwanted or beyond kMostWriters
    uint64_t sender = 0;             ///< 0 beyond kMostWriters
    int64_t source_ns = 0;
  };

  DdsReader(const DdsParticipant& participant, const std::string& topic, int max_waiting = kMaxWaiting)
      : DdsReader(participant.make_reader(make_topic(participant, topic), max_waiting)) {}
  static DdsReader of_others(const DdsParticipant& participant, const std::string& topic, int depth = kRosDepth) {
    return DdsReader(participant.make_reader_of_others(make_topic(participant, topic), depth));
  }

  dds_entity_t entity() const { return reader_; }
  DdsSenders& senders() { return senders_; }

  /// Decodes the next message only if `is_wanted(sender)`.
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

class DdsWaitset {
 public:
  explicit DdsWaitset(const DdsParticipant& participant);
  void add(dds_entity_t reader);
  void wait(int64_t timeout_ns) const;

 private:
  dds_entity_t waitset_;
};

}  // namespace glovebench
