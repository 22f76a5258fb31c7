#include "core/robot/dds/security_keys.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/robot/dds/topics.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestFile = 1 << 20;  // bytes

std::string topic_list(const char* element, const std::vector<std::string>& topics) {
  if (topics.empty()) return "";
  std::string text = fmt::format("        <{}>\n          <topics>\n", element);
  for (const std::string& topic : topics) text += fmt::format("            <topic>{}</topic>\n", topic);
  return text + fmt::format("          </topics>\n        </{}>\n", element);
}

std::string utc(int64_t time_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", fmt::gmtime(static_cast<time_t>(time_s)));
}

[[noreturn]] void refuse(const std::string& path, const char* what, const std::string& expected) {
  throw Error(path, what, std::strerror(errno), expected);
}

/// Whoever may read the folder reads all but what has mode 0600.
void write_new_file(const std::string& path, std::string_view content, mode_t mode) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) refuse(path, "file", "a new one");
  bool fine = true;
  while (fine && !content.empty()) {
    const ssize_t count = write(file, content.data(), content.size());
    fine = count > 0;
    if (fine) content.remove_prefix(static_cast<size_t>(count));
  }
  fine = fine && fsync(file) == 0;
  fine = close(file) == 0 && fine;
  if (!fine) refuse(path, "file", "room for it");
}

void write_all(const std::string& folder, const Validity& validity, const std::map<std::string, Validity>& others) {
  const Authority identities("glovebench identities", validity), permissions("glovebench permissions", validity);
  constexpr mode_t kPublic = 0644, kSecret = 0600;
  write_new_file(folder + "/identity_ca.pem", identities.certificate(), kPublic);
  write_new_file(folder + "/permissions_ca.pem", permissions.certificate(), kPublic);
  write_new_file(folder + "/governance.p7s", permissions.sign(governance_document()), kPublic);
  for (const SecurityRole& role : security_roles()) {
    const auto other = others.find(role.name);
    const Validity& its = other == others.end() ? validity : other->second;
    const Identity identity = identities.issue("glovebench-" + role.name, its);
    const std::string base = folder + "/" + role.name;
    write_new_file(base + ".pem", identity.certificate, kPublic);
    write_new_file(base + ".key", identity.private_key, kSecret);
    write_new_file(base + ".p7s", permissions.sign(permissions_document(role, its)), kPublic);
  }
}

PemFile read_pem(const fs::path& folder, const std::string& name) {
  const std::string path = (folder / name).string();
  return {path, read_file(path, kLargestFile)};
}

}  // namespace

const std::vector<SecurityRole>& security_roles() {
  static const std::vector<SecurityRole> roles = [] {
    const Topics& own = topics::kOwn;
    const Topics& controller = topics::kController;
    const std::string measured = topics::kMeasuredJointStates;
    return std::vector<SecurityRole>{
        {"sender",
         {own.hand, own.wrist, own.arm, controller.hand, controller.wrist, controller.arm},
         {own.joint_states, controller.joint_states, measured}},
        {"hand", {own.joint_states}, {own.hand, own.wrist, own.joint_states, measured}},
        {"arm", {own.joint_states}, {own.arm, own.joint_states, measured}},
        {"robot",
         {measured, controller.joint_states},
         {own.joint_states, controller.hand, controller.wrist, controller.arm}},
        {"observer", {}, {"*"}}};
  }();
  return roles;
}

std::string governance_document() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains>
        <id_range>
          <min>0</min>
          <max>230</max>
        </id_range>
      </domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT_WITH_ORIGIN_AUTHENTICATION</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>NONE</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

std::string permissions_document(const SecurityRole& role, const Validity& validity) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name="{0}">
      <subject_name>CN=glovebench-{0}</subject_name>
      <validity>
        <not_before>{1}</not_before>
        <not_after>{2}</not_after>
      </validity>
      <allow_rule>
        <domains>
          <id_range>
            <min>0</min>
            <max>230</max>
          </id_range>
        </domains>
{3}{4}      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
                     role.name, utc(validity.begin_s), utc(validity.end_s), topic_list("publish", role.writes),
                     topic_list("subscribe", role.reads));
}

void make_security_keys(const std::string& folder, const Validity& validity,
                        const std::map<std::string, Validity>& others) {
  const fs::path target = fs::absolute(folder).lexically_normal();
  const fs::path whole = target.has_filename() ? target : target.parent_path();
  std::string made = whole.string() + ".XXXXXX";
  if (!mkdtemp(made.data())) refuse(folder, "folder", "a place for a new folder");  // mode 0700
  try {
    write_all(made, validity, others);
    if (rename(made.c_str(), whole.c_str()) != 0)
      refuse(folder, "folder", "none, or an empty one: keys are not replaced");
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(made, ignored);
    throw;
  }
}

std::string security_configuration(const std::string& folder, const std::string& role, int64_t now_s) {
  std::error_code error;
  const fs::path from = fs::canonical(folder, error);
  if (error || !fs::is_directory(from))
    throw Error(folder, "folder", error ? error.message() : "a file", "one of `glovebench robot-server keys`");
  // The path becomes part of a document in which Cyclone DDS replaces ${...}.
  if (from.string().find_first_of("<>&\"'$") != std::string::npos)
    throw Error(from.string(), "folder", "one of < > & \" ' $ in its path", "none of them");
  const PemFile identities = read_pem(from, "identity_ca.pem"), permissions = read_pem(from, "permissions_ca.pem"),
                governance = read_pem(from, "governance.p7s"), certificate = read_pem(from, role + ".pem"),
                key = read_pem(from, role + ".key"), rights = read_pem(from, role + ".p7s");
  for (const PemFile* file : {&identities, &permissions, &certificate}) check_certificate(*file, now_s);
  check_identity(certificate, key, identities);
  for (const PemFile* file : {&governance, &rights}) check_signature(*file, permissions);
  return fmt::format(
      "<Security><Authentication><Library/><IdentityCA>file:{}</IdentityCA><IdentityCertificate>file:{}"
      "</IdentityCertificate><PrivateKey>file:{}</PrivateKey></Authentication><AccessControl><Library/>"
      "<PermissionsCA>file:{}</PermissionsCA><Governance>file:{}</Governance><Permissions>file:{}</Permissions>"
      "</AccessControl><Cryptographic><Library/></Cryptographic></Security>",
      identities.path, certificate.path, key.path, permissions.path, governance.path, rights.path);
}

}  // namespace glovebench
