#include "core/robot/dds/dds_entity.h"

#include <dds/ddsrt/log.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kRosDepth = 10;
constexpr int kLastDomain = 230;  // later ones have no ports
constexpr int kLinesPerSecond = 10;

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// ROS 2's defaults, but for the history.
Qos make_qos() {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  return qos;
}

std::atomic<int64_t> messages_too_large = 0;

/// What the library says: to stderr, as without this, but not without end.
void hear_library(void*, const dds_log_data_t* said) {
  using namespace std::chrono;
  static std::mutex mutex;
  static int64_t second = 0, lines = 0;
  const std::lock_guard lock(mutex);
  messages_too_large += std::string_view(said->message, said->size).starts_with("dropping oversize");
  const int64_t now = duration_cast<seconds>(steady_clock::now().time_since_epoch()).count();
  if (std::exchange(second, now) != now) lines = 0;
  if (++lines <= kLinesPerSecond)
    std::fwrite(said->message - said->hdrsize, 1, said->hdrsize + said->size + 1, stderr);
}

/// A domain of this process, for as long as somebody has it: it is deleted with all that lives in it.
std::shared_ptr<const dds_entity_t> join_domain(int domain, const std::string& what, const std::string& expected) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<const dds_entity_t>> domains;
  const std::lock_guard lock(mutex);
  if (std::shared_ptr<const dds_entity_t> joined = domains[domain].lock()) return joined;
  dds_set_log_sink(&hear_library, nullptr);
  const char* const own = std::getenv("CYCLONEDDS_URI");
  const std::string configuration = fmt::format(
      "{},<CycloneDDS><Domain><Internal><MaxSampleSize>{}B</MaxSampleSize></Internal></Domain></CycloneDDS>",
      own ? own : "", kLargestMessage);
  const dds_entity_t made =
      checked_dds(dds_create_domain(static_cast<dds_domainid_t>(domain), configuration.c_str()), what, expected);
  const auto leave = [](const dds_entity_t* entity) {
    dds_delete(*entity);
    delete entity;
  };
  const std::shared_ptr<const dds_entity_t> joined(new dds_entity_t(made), leave);
  domains[domain] = joined;
  return joined;
}

}  // namespace

int64_t dds_messages_too_large() {
  return messages_too_large;
}

dds_entity_t checked_dds(dds_entity_t result, const std::string& what, const std::string& expected) {
  if (result < 0) throw Error("DDS", what, dds_strretcode(-result), expected);
  return result;
}

DdsParticipant::DdsParticipant(int domain) {
  if (domain < 0 || domain > kLastDomain)
    throw Error("DDS", "domain", std::to_string(domain), fmt::format("0 to {}", kLastDomain));
  const std::string what = fmt::format("participant in domain {}", domain);
  const char* const expected = "a network interface that CYCLONEDDS_URI allows";
  domain_ = join_domain(domain, what, expected);
  entity_ =
      checked_dds(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr), what, expected);
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

dds_entity_t DdsParticipant::make_reader_of_others(dds_entity_t topic) const {
  const Qos qos = make_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kRosDepth);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
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
