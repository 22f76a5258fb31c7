#pragma once

#include <string>

namespace glovebench {

/// Where a participant of DDS talks, and as whom.
struct DdsAccess {
  /// The network interface. Empty: what CYCLONEDDS_URI says, if that is set; otherwise loopback alone.
  std::string interface;
  /// Folder of keys (`glovebench robot-server keys`) for DDS Security; empty: without.
  std::string security;
  std::string role;  ///< whose keys (`security_roles`)

  bool operator==(const DdsAccess&) const = default;
};

}  // namespace glovebench
