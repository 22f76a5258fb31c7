#include "core/adapters/dds/security_keys.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/openssl.h"
#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"

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

// Of `openssl ca`, which keeps files of its own beside it.
constexpr const char* kSettings = R"([ca]
default_ca = own
[own]
database = index
new_certs_dir = .
default_md = sha256
policy = name
rand_serial = yes
unique_subject = no
[name]
commonName = supplied
[req]
distinguished_name = no_more_than_the_name
prompt = no
[no_more_than_the_name]
[authority]
basicConstraints = critical,CA:TRUE
keyUsage = critical,keyCertSign,digitalSignature
[holder]
basicConstraints = critical,CA:FALSE
keyUsage = critical,digitalSignature
)";

/// What `openssl` prints. Throws Error if it fails.
std::string made_by_openssl(const std::string& folder, const std::vector<std::string>& arguments,
                            std::string_view input = "") {
  const OpensslResult result = run_openssl(folder, arguments, input);
  if (!result.is_success)
    throw Error("openssl", arguments.front(), result.reason, "a key, certificate or signature");
  return result.output;
}

/// Makes keys with certificates, and signs documents. `openssl` works in a folder of its own.
class Authority {
 public:
  /// Its own certificate is NAME.pem.
  Authority(const std::string& folder, WholeFiles& keys, const std::string& name, const std::string& common_name,
            const Validity& validity)
      : folder_(folder), keys_(keys), certificate_(name + ".pem"), key_(new_key()) {
    certify(certificate_, common_name, validity, key_, {"-selfsign", "-extensions", "authority"});
  }

  /// NAME.pem and NAME.key.
  void issue(const std::string& name, const std::string& common_name, const Validity& validity) const {
    const std::string key = new_key();
    keys_.add(name + ".key", key, kSecret);
    certify(name + ".pem", common_name, validity, key, {"-cert", certificate_, "-extensions", "holder"});
  }

  /// The document as S/MIME: in the clear, with a signature beside it.
  void sign(const std::string& file, const std::string& document) const {
    write_file(folder_ + "/" + file, document);
    // DDS Security wants a text/plain part.
    keys_.add(file, made_by_openssl(folder_,
                                    {"smime", "-sign", "-text", "-md", "sha256", "-signer", certificate_, "-inkey",
                                     "/dev/stdin", "-in", file},
                                    key_));
  }

 private:
  std::string new_key() const {
    return made_by_openssl(folder_, {"genpkey", "-algorithm", "EC", "-pkeyopt", "ec_paramgen_curve:P-256"});
  }

  void certify(const std::string& file, const std::string& common_name, const Validity& validity,
               const std::string& key, const std::vector<std::string>& how) const {
    const std::string request = file + ".request";
    write_file(folder_ + "/" + request, made_by_openssl(folder_,
                                                        {"req", "-new", "-config", "settings", "-subj",
                                                         "/CN=" + common_name, "-key", "/dev/stdin"},
                                                        key));
    std::vector<std::string> arguments = {"ca",
                                          "-batch",
                                          "-notext",
                                          "-config",
                                          "settings",
                                          "-keyfile",
                                          "/dev/stdin",
                                          "-in",
                                          request,
                                          "-startdate",
                                          date(validity.begin_s),
                                          "-enddate",
                                          date(validity.end_s)};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const std::string certificate = made_by_openssl(folder_, arguments, key_);
    write_file(folder_ + "/" + file, certificate);  // `openssl` reads that of an authority again
    keys_.add(file, certificate);
  }

  static std::string date(int64_t time_s) {
    return fmt::format("{:%Y%m%d%H%M%S}Z", fmt::gmtime(static_cast<time_t>(time_s)));
  }

  static constexpr mode_t kSecret = 0600;
  std::string folder_;
  WholeFiles& keys_;
  std::string certificate_, key_;
};

void make_all(const std::string& folder, const Validity& validity, const std::map<std::string, Validity>& others) {
  WholeFiles keys(folder);
  const std::string work = folder + "/work";
  write_file(work + "/settings", kSettings);
  write_file(work + "/index", "");
  const Authority identities(work, keys, "identity_ca", "glovebench identities", validity);
  const Authority permissions(work, keys, "permissions_ca", "glovebench permissions", validity);
  permissions.sign("governance.p7s", governance_document());
  for (const SecurityRole& role : security_roles()) {
    const auto other = others.find(role.name);
    const Validity& its = other == others.end() ? validity : other->second;
    identities.issue(role.name, "glovebench-" + role.name, its);
    permissions.sign(role.name + ".p7s", permissions_document(role, its));
  }
  fs::remove_all(work);
  keys.commit();
}

/// The files of a folder of keys, which `openssl` reads there.
class KeyFolder {
 public:
  explicit KeyFolder(fs::path folder) : folder_(std::move(folder)) {}

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Throws Error unless it is a file of a small size.
  void check_readable(const std::string& name) const { read_regular_file(path(name), kLargestFile); }

  /// Throws Error unless it is a certificate that holds at `now_s`.
  void check_certificate(const std::string& name, int64_t now_s) const {
    const OpensslResult dates =
        run({"x509", "-in", name, "-noout", "-startdate", "-enddate", "-dateopt", "iso_8601"});
    const size_t from = dates.output.find("notBefore="), until = dates.output.find("notAfter=");
    if (!dates.is_success || from == std::string::npos || until == std::string::npos)
      throw Error(path(name), "certificate", "none that can be read", "one of X.509, as PEM");
    const auto date_at = [&](size_t place) {
      const size_t begin = dates.output.find('=', place) + 1;
      return dates.output.substr(begin, dates.output.find('\n', begin) - begin);
    };
    // Dates of this form have the order of their texts.
    const std::string begin = date_at(from), end = date_at(until),
                      now = fmt::format("{:%Y-%m-%d %H:%M:%S}Z", fmt::gmtime(static_cast<time_t>(now_s)));
    if (begin > now) throw Error(path(name), "certificate", "one that begins " + begin, "one that holds now");
    if (end < now) throw Error(path(name), "certificate", "one that expired " + end, "one that holds now");
  }

  /// Throws Error unless the authority has issued the certificate, and the private key is the certificate's.
  void check_identity(const std::string& certificate, const std::string& key, const std::string& authority) const {
    if (!run({"verify", "-no_check_time", "-no-CApath", "-no-CAstore", "-CAfile", authority, certificate})
             .is_success)
      throw Error(path(certificate), "certificate", "one of another authority", "one of " + path(authority));
    const OpensslResult own = run({"pkey", "-in", key, "-passin", "pass:", "-pubout"});
    if (!own.is_success)
      throw Error(path(key), "private key", "none that can be read", "one as PEM, without a password");
    if (own.output != run({"x509", "-in", certificate, "-noout", "-pubkey"}).output)
      throw Error(path(key), "private key", "another one", "that of " + path(certificate));
  }

  /// Throws Error unless the authority has signed the document.
  void check_signature(const std::string& document, const std::string& authority) const {
    // The time is check_certificate's.
    if (!run({"smime", "-verify", "-text", "-no_check_time", "-no-CApath", "-no-CAstore", "-CAfile", authority,
              "-in", document})
             .is_success)
      throw Error(path(document), "signature", "none that fits",
                  "a document that " + path(authority) + " has signed");
  }

 private:
  OpensslResult run(const std::vector<std::string>& arguments) const {
    return run_openssl(folder_.string(), arguments);
  }

  fs::path folder_;
};

/// The path becomes part of a document in which Cyclone DDS replaces ${...}.
void check_path(const fs::path& folder) {
  if (folder.string().find_first_of("<>&\"'$") != std::string::npos)
    throw Error(folder.string(), "folder", "one of < > & \" ' $ in its path", "none of them");
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
        {"server", {own.joint_states}, {own.hand, own.wrist, own.arm, own.joint_states, measured}},
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
  if (folder.empty()) throw Error("keys", "folder", "an empty name", "the name of a new folder");
  const fs::path target = fs::absolute(folder).lexically_normal();
  const fs::path whole = target.has_filename() ? target : target.parent_path();
  check_path(fs::weakly_canonical(whole));
  std::string made = whole.string() + ".XXXXXX";
  if (!mkdtemp(made.data())) refuse(folder, "folder", "a place for a new folder");  // mode 0700
  try {
    make_all(made, validity, others);
    if (rename(made.c_str(), whole.c_str()) != 0)
      refuse(folder, "folder", "none, or an empty one: keys are not replaced");
    sync_folder(whole.parent_path().string());
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
  check_path(from);
  const KeyFolder keys(from);
  const std::string certificate = role + ".pem", key = role + ".key", rights = role + ".p7s";
  if (!fs::exists(from / certificate) && fs::exists(from / "hand.pem"))
    throw Error(folder, "keys", "those of an older version, without " + certificate,
                "new ones of robot-server keys");
  for (const std::string& file : {std::string("identity_ca.pem"), std::string("permissions_ca.pem"),
                                  std::string("governance.p7s"), certificate, key, rights})
    keys.check_readable(file);
  for (const std::string& file : {std::string("identity_ca.pem"), std::string("permissions_ca.pem"), certificate})
    keys.check_certificate(file, now_s);
  keys.check_identity(certificate, key, "identity_ca.pem");
  for (const std::string& file : {std::string("governance.p7s"), rights})
    keys.check_signature(file, "permissions_ca.pem");
  return fmt::format(
      "<Security><Authentication><Library/><IdentityCA>file:{}</IdentityCA><IdentityCertificate>file:{}"
      "</IdentityCertificate><PrivateKey>file:{}</PrivateKey></Authentication><AccessControl><Library/>"
      "<PermissionsCA>file:{}</PermissionsCA><Governance>file:{}</Governance><Permissions>file:{}</Permissions>"
      "</AccessControl><Cryptographic><Library/></Cryptographic></Security>",
      keys.path("identity_ca.pem"), keys.path(certificate), keys.path(key), keys.path("permissions_ca.pem"),
      keys.path("governance.p7s"), keys.path(rights));
}

}  // namespace glovebench
