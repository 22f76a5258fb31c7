#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// DDS Security among `track`, the server, a robot's driver and those who watch: files that say who may do what.
/// X.509 certificates and S/MIME signatures by the program `openssl`: EC P-256 keys, SHA-256, PEM.
namespace glovebench {

/// From when until when a certificate holds, seconds since 1970.
struct Validity {
  int64_t begin_s = 0;
  int64_t end_s = 0;
};

/// A part in the play: topics that it may write and read (patterns of fnmatch).
struct SecurityRole {
  std::string name;
  std::vector<std::string> writes, reads;
};
/// `sender` (track), `server`, `robot` (a driver that measures the joints), `observer`.
const std::vector<SecurityRole>& security_roles();

/// What protects the bus: everybody must prove who he is, and everything is encrypted, with proof of its origin.
std::string governance_document();
/// What a role may do.
std::string permissions_document(const SecurityRole& role, const Validity& validity);

/// Makes a folder, mode 0700, with two authorities' certificates (`identity_ca.pem`, `permissions_ca.pem`), their
/// signed `governance.p7s`, and for each role NAME.pem, NAME.key (mode 0600) and NAME.p7s: one set of files
/// (core/base/file_set.h), with a manifest of mode 0600. The authorities' private keys are never on a disk: who
/// needs another role or more time makes another folder. `others`: roles with another validity. Throws Error if the
/// folder exists and is not empty, or cannot be made.
void make_security_keys(const std::string& folder, const Validity& validity,
                        const std::map<std::string, Validity>& others = {});

/// Cyclone DDS's configuration for a role with the keys of a folder. Throws Error naming the file if one is
/// missing, unreadable, expired at `now_s`, or does not belong to the others.
std::string security_configuration(const std::string& folder, const std::string& role, int64_t now_s);

}  // namespace glovebench
