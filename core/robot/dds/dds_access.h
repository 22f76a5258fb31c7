#pragma once

#include <string>

namespace glovebench {

/// Where a participant of DDS talks.
struct DdsAccess {
  /// The network interface. Empty: what CYCLONEDDS_URI says, if that is set; otherwise loopback alone.
  std::string interface;

  bool operator==(const DdsAccess&) const = default;
};

}  // namespace glovebench
