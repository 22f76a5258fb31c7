#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

// Keys for DDS Security, made by `openssl` (EC P-256, SHA-256).
namespace glovebench {

/// Seconds since 1970.
struct Validity {
  int64_t begin_s = 0;
  int64_t end_s = 0;
};

/// Topics as fnmatch patterns.
struct SecurityRole {
  std::string name;
  std::vector<std::string> writes, reads;
};
/// `sender` (track), `server`, `robot` (its driver), `observer`.
const std::vector<SecurityRole>& security_roles();

/// Requires identities and encryption.
std::string governance_document();
std::string permissions_document(const SecurityRole& role, const Validity& validity);

/// Makes all keys (core/adapters/dds/README.md, "DDS Security"). `others`: roles with another validity.
/// Throws: Error if the folder is not empty or cannot be made.
void make_security_keys(const std::string& folder, const Validity& validity,
                        const std::map<std::string, Validity>& others = {});

/// Cyclone DDS's configuration.
/// Throws: Error if a file is missing, unreadable, expired at `now_s` or of another key set.
std::string security_configuration(const std::string& folder, const std::string& role, int64_t now_s);

}  // namespace glovebench
