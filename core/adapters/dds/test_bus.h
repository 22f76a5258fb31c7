#pragma once

// A bus of its own for each test of the middleware, on the loopback interface. Not part of the library.

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>

namespace glovebench {

/// This process and those that it starts get a Cyclone DDS for a sandbox: one interface, no multicast, and a tag
/// that keeps apart what runs at the same time. `more`: further elements of the configuration.
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

/// Asks again and again; whether it came true within a time in which it should by far.
template <typename Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace glovebench
