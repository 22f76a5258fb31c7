#pragma once

// A private loopback bus for tests.

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>

namespace glovebench {

/// Gives this process and its children a Cyclone DDS of their own on loopback. `more`: further configuration.
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

/// Waits up to 20 s.
template <typename Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace glovebench
