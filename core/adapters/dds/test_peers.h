#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>

#include "core/adapters/dds/dds_entity.h"

namespace glovebench {

/// kFar reaches kDomain through the network only.
inline constexpr int kDomain = 7, kFar = 8;
inline constexpr const char* kFarDomain =
    "<Domain id=\"8\"><Discovery><ExternalDomainId>7</ExternalDomainId></Discovery></Domain>";

class UnboundedWriter {
 public:
  explicit UnboundedWriter(const std::string& topic)
      : participant_(checked_dds(dds_create_participant(kFar, nullptr, nullptr), "participant", "one")) {
    const dds_entity_t made = dds_create_topic(participant_, &DdsType<ros::JointTrajectory>::descriptor(),
                                               topic.c_str(), nullptr, nullptr);
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    writer_ = checked_dds(dds_create_writer(participant_, made, qos, nullptr), topic, "a writer");
    dds_delete_qos(qos);
  }
  ~UnboundedWriter() { dds_delete(participant_); }
  UnboundedWriter(const UnboundedWriter&) = delete;
  UnboundedWriter& operator=(const UnboundedWriter&) = delete;

  void write(const ros::JointTrajectory& message) const {
    checked_dds(DdsType<ros::JointTrajectory>::write(writer_, message, dds_time()), "message", "one that is sent");
  }
  int listeners() const {
    dds_publication_matched_status_t status = {};
    dds_get_publication_matched_status(writer_, &status);
    return static_cast<int>(status.current_count);
  }

 private:
  dds_entity_t participant_, writer_ = 0;
};

/// Gives this process and its children a private loopback bus. `more`: configuration.
inline void use_loopback_dds(const std::string& more = "") {
  const std::string uri =
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General><Discovery><Tag>glovebench-" +
      std::to_string(getpid()) + "-" + std::to_string(std::random_device()()) +
      "</Tag><Peers><Peer address=\"127.0.0.1\"/></Peers><ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex></Discovery></Domain>" +
      more + "</CycloneDDS>";
  setenv("CYCLONEDDS_URI", uri.c_str(), 1);
}

/// Waits up to a minute.
template <typename Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace glovebench
