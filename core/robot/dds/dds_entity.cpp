#include "core/robot/dds/dds_entity.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kRosDepth = 10;
constexpr int kLastDomain = 230;  // later ones have no ports

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// ROS 2's defaults, but for the history.
Qos make_qos() {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  return qos;
}

}  // namespace

dds_entity_t checked_dds(dds_entity_t result, const std::string& what, const std::string& expected) {
  if (result < 0) throw Error("DDS", what, dds_strretcode(-result), expected);
  return result;
}

DdsParticipant::DdsParticipant(int domain) {
  if (domain < 0 || domain > kLastDomain)
    throw Error("DDS", "domain", std::to_string(domain), fmt::format("0 to {}", kLastDomain));
  entity_ = checked_dds(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                        fmt::format("participant in domain {}", domain),
                        "a network interface that CYCLONEDDS_URI allows");
}

dds_entity_t DdsParticipant::make_topic(const dds_topic_descriptor_t& type, const std::string& name) const {
  return checked_dds(dds_create_topic(entity_, &type, name.c_str(), nullptr, nullptr), name, "a topic");
}

dds_entity_t DdsParticipant::make_writer(dds_entity_t topic) const {
  const Qos qos = make_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kRosDepth);
  return checked_dds(dds_create_writer(entity_, topic, qos.get(), nullptr), "writer", "one");
}

dds_entity_t DdsParticipant::make_reader(dds_entity_t topic, int max_waiting) const {
  const Qos qos = make_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  dds_qset_resource_limits(qos.get(), max_waiting, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return checked_dds(dds_create_reader(entity_, topic, qos.get(), nullptr), "reader", "one");
}

uint64_t DdsSenders::look_up(dds_instance_handle_t writer) const {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader_, writer);
  if (!endpoint) return writer;  // gone before it was ever seen: a sender of its own
  const uint64_t participant = endpoint->participant_instance_handle;
  dds_builtintopic_free_endpoint(endpoint);
  return participant;
}

uint64_t DdsSenders::of(dds_instance_handle_t writer) {
  const auto known = participants_.find(writer);
  if (known != participants_.end()) return known->second;
  return participants_[writer] = look_up(writer);
}

std::set<uint64_t> DdsSenders::present() {
  std::vector<dds_instance_handle_t> writers(16);
  dds_return_t count = 0;
  while ((count = dds_get_matched_publications(reader_, writers.data(), writers.size())) >
         static_cast<dds_return_t>(writers.size()))
    writers.resize(static_cast<size_t>(count));
  writers.resize(static_cast<size_t>(std::max(count, 0)));
  std::erase_if(participants_, [&](const auto& known) {
    return std::find(writers.begin(), writers.end(), known.first) == writers.end();
  });
  std::set<uint64_t> senders;
  for (const dds_instance_handle_t writer : writers) senders.insert(of(writer));
  return senders;
}

DdsWaitset::DdsWaitset(const DdsParticipant& participant)
    : waitset_(checked_dds(dds_create_waitset(participant.entity()), "waitset", "one")) {}

void DdsWaitset::add(dds_entity_t reader) {
  const dds_entity_t condition = checked_dds(dds_create_readcondition(reader, DDS_ANY_STATE), "condition", "one");
  checked_dds(dds_waitset_attach(waitset_, condition, 0), "waitset", "another reader");
}

void DdsWaitset::wait(int64_t timeout_ns) const {
  checked_dds(dds_waitset_wait(waitset_, nullptr, 0, std::max<int64_t>(timeout_ns, 0)), "waitset", "a wait");
}

}  // namespace glovebench
