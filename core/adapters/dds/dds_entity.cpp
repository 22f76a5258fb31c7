#include "core/adapters/dds/dds_entity.h"

#include <dds/ddsrt/log.h>
#include <fmt/format.h>
#include <net/if.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "core/adapters/dds/security_keys.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kLastDomain = 230;  // later ones have no ports
constexpr int kLinesPerSecond = 10;
constexpr std::chrono::milliseconds kLook{1000};
constexpr const char* kUsable = "a network interface that CYCLONEDDS_URI allows, and keys that DDS Security takes";

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// ROS 2's defaults, but for the history.
Qos make_qos() {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  return qos;
}

std::atomic<int64_t> messages_too_large = 0, messages_of_too_many = 0;

/// Writes the library's lines to stderr, but only so many a second.
void hear_library(void*, const dds_log_data_t* said) {
  using namespace std::chrono;
  static std::mutex mutex;
  static int64_t second = 0, lines = 0;
  const std::lock_guard lock(mutex);
  messages_too_large += std::string_view(said->message, said->size).starts_with("dropping oversize");
  const int64_t now = duration_cast<seconds>(steady_clock::now().time_since_epoch()).count();
  if (std::exchange(second, now) != now) lines = 0;
  pollfd to_person = {STDERR_FILENO, POLLOUT, 0};  // a blocked reader of stderr blocks nothing here
  if (++lines <= kLinesPerSecond && ::poll(&to_person, 1, 0) == 1 && (to_person.revents & POLLOUT))
    std::fwrite(said->message - said->hdrsize, 1, said->hdrsize + said->size + 1, stderr);
}

/// Sends on this host only. Receive sockets still listen on all addresses.
constexpr const char* kLoopback =
    "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex><Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery>";

/// The library's configuration of a domain.
std::string configuration(const DdsAccess& access) {
  const char* const uri = std::getenv("CYCLONEDDS_URI");
  const bool configured = uri && *uri;
  std::string where;
  if (!access.interface.empty()) {
    if (configured) throw Error("DDS", "interface", access.interface + " beside CYCLONEDDS_URI", "one of the two");
    if (if_nametoindex(access.interface.c_str()) == 0)
      throw Error("DDS", "interface", access.interface, "a network interface of this host, e.g. eth0");
  }
  if (access.interface == "lo" || (access.interface.empty() && !configured)) {
    where = kLoopback;
  } else if (!access.interface.empty()) {
    where = fmt::format("<General><Interfaces><NetworkInterface name=\"{}\"/></Interfaces></General>",
                        access.interface);
  }
  const std::string security =
      access.security.empty() ? "" : security_configuration(access.security, access.role, system_us() / 1'000'000);
  return fmt::format(
      "{}<CycloneDDS><Domain>{}{}<Internal><MaxSampleSize>{}B</MaxSampleSize></Internal></Domain></CycloneDDS>",
      configured ? std::string(uri) + "," : "", where, security, kLargestMessage);
}

}  // namespace

/// A domain of this process, deleted with its entities when the last participant is gone.
struct DdsDomain {
  DdsDomain(int domain, const DdsAccess& its)
      : access(its),
        entity(checked_dds(dds_create_domain(static_cast<dds_domainid_t>(domain), configuration(its).c_str()),
                           fmt::format("domain {}", domain), kUsable)) {}
  ~DdsDomain() { dds_delete(entity); }
  DdsDomain(const DdsDomain&) = delete;
  DdsDomain& operator=(const DdsDomain&) = delete;

  const DdsAccess access;
  const dds_entity_t entity;
};

namespace {

std::shared_ptr<const DdsDomain> join_domain(int domain, const DdsAccess& access) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<const DdsDomain>> domains;
  const std::lock_guard lock(mutex);
  if (std::shared_ptr<const DdsDomain> joined = domains[domain].lock()) {
    if (joined->access != access)
      throw Error("DDS", fmt::format("domain {}", domain), "two ways to talk in one process", "one");
    return joined;
  }
  dds_set_log_sink(&hear_library, nullptr);
  const auto joined = std::make_shared<const DdsDomain>(domain, access);
  domains[domain] = joined;
  return joined;
}

}  // namespace

int64_t dds_messages_too_large() { return messages_too_large; }

int64_t dds_messages_of_too_many() { return messages_of_too_many; }

dds_entity_t checked_dds(dds_entity_t result, const std::string& what, const std::string& expected) {
  if (result < 0) throw Error("DDS", what, dds_strretcode(-result), expected);
  return result;
}

DdsParticipant::DdsParticipant(int domain, const DdsAccess& access) {
  if (domain < 0 || domain > kLastDomain)
    throw Error("DDS", "domain", std::to_string(domain), fmt::format("0 to {}", kLastDomain));
  domain_ = join_domain(domain, access);
  entity_ = checked_dds(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                        fmt::format("participant in domain {}", domain), kUsable);
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

dds_entity_t DdsParticipant::make_reader_of_others(dds_entity_t topic, int depth) const {
  const Qos qos = make_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return checked_dds(dds_create_reader(entity_, topic, qos.get(), nullptr), "reader", "one");
}

DdsOtherWriters::DdsOtherWriters(const DdsParticipant& participant, std::vector<std::string> topics)
    : topics_(std::move(topics)),
      publications_(
          checked_dds(dds_create_reader(participant.entity(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
                      "publications", "a reader")) {
  checked_dds(dds_get_domainid(participant.entity(), &domain_), "participant", "one in a domain");
  checked_dds(dds_get_instance_handle(participant.entity(), &own_), "participant", "one with a handle");
  const auto end = std::chrono::steady_clock::now() + kLook;
  for (refuse(); std::chrono::steady_clock::now() < end; refuse()) std::this_thread::sleep_for(kLook / 100);
}

void DdsOtherWriters::refuse() {
  for (;;) {
    void* sample = nullptr;
    dds_sample_info_t info;
    if (dds_take(publications_, &sample, &info, 1, 1) <= 0) break;
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    if (info.instance_state != DDS_ALIVE_INSTANCE_STATE)
      writers_.erase(info.instance_handle);
    else if (endpoint.participant_instance_handle != own_ &&
             std::ranges::find(topics_, endpoint.topic_name) != topics_.end())
      writers_[info.instance_handle] = endpoint.topic_name;
    dds_return_loan(publications_, &sample, 1);
  }
  if (writers_.empty()) return;
  throw Error(fmt::format("DDS domain {}", domain_), writers_.begin()->second, "another process that writes it",
              "one writer: two would share no limit");
}

std::optional<uint64_t> DdsSenders::look_up(dds_instance_handle_t writer) const {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader_, writer);
  if (!endpoint) return std::nullopt;
  const uint64_t participant = endpoint->participant_instance_handle;
  dds_builtintopic_free_endpoint(endpoint);
  return participant;
}

std::optional<uint64_t> DdsSenders::of(dds_instance_handle_t writer) {
  const auto known = participants_.find(writer);
  if (known != participants_.end()) return known->second;
  if (participants_.size() >= kMostWriters)
    std::erase_if(participants_, [&](const auto& entry) { return !look_up(entry.first); });  // gone writers
  if (participants_.size() >= kMostWriters) {
    ++messages_of_too_many;
    return std::nullopt;
  }
  return participants_[writer] = look_up(writer).value_or(writer);  // gone already: its own sender
}

std::set<uint64_t> DdsSenders::present() {
  std::erase_if(participants_, [&](const auto& known) { return !look_up(known.first); });
  std::set<uint64_t> senders;
  for (const auto& [writer, participant] : participants_) senders.insert(participant);
  std::array<dds_instance_handle_t, kMostWriters> writers;  // only the first ones
  const dds_return_t count = dds_get_matched_publications(reader_, writers.data(), writers.size());
  for (size_t i = 0; i < std::min(static_cast<size_t>(std::max(count, 0)), writers.size()); ++i)
    if (const std::optional<uint64_t> participant = look_up(writers[i])) senders.insert(*participant);
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
