#include "core/adapters/dds/security_keys.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr int64_t kDay = 86'400, kNow = 1'800'000'000;
constexpr Validity kGood = {kNow - kDay, kNow + kDay};

class SecurityKeys : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    make_security_keys(path("keys"), kGood);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// What is wrong with the keys of the sender.
  std::string fault(int64_t now_s = kNow) const {
    const std::string error = thrown_by([&] { security_configuration(path("keys"), "sender", now_s); });
    EXPECT_EQ(error.find('\n'), std::string::npos);
    return error;
  }
  /// What is wrong while a file has another content.
  std::string fault_with(const std::string& name, const std::string& content) const {
    const std::string file = path("keys/") + name, before = read_file(file);
    write_file(file, content);
    const std::string found = fault();
    write_file(file, before);
    return found;
  }
  static int mode(const std::string& file) {
    struct stat its = {};
    EXPECT_EQ(stat(file.c_str(), &its), 0) << file;
    return static_cast<int>(its.st_mode & 07777);
  }

  std::string folder_ = test_folder();
};

TEST_F(SecurityKeys, AreCompleteAndPrivate) {
  EXPECT_EQ(mode(path("keys")), 0700);
  for (const SecurityRole& role : security_roles()) {
    EXPECT_EQ(mode(path("keys/" + role.name + ".key")), 0600);
    EXPECT_THAT(security_configuration(path("keys"), role.name, kNow),
                HasSubstr("/" + role.name + ".p7s</Permissions>"));
  }
  const auto count = std::distance(fs::directory_iterator(path("keys")), fs::directory_iterator());
  EXPECT_EQ(count, 3 + 3 * std::ssize(security_roles()) + 1) << "with a manifest, and no key of an authority";
  EXPECT_EQ(mode(path("keys/manifest.json")), 0600) << "it has hashes of private keys";
  const FileSet keys(path("keys"));
  EXPECT_EQ(keys.read("sender.key"), read_file(path("keys/sender.key")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "nothing is left over";
}

TEST_F(SecurityKeys, AreNeverReplaced) {
  const std::string before = read_file(path("keys/sender.key"));
  EXPECT_THROW(make_security_keys(path("keys"), kGood), Error);
  EXPECT_THROW(make_security_keys(path("keys/"), kGood), Error);
  EXPECT_THROW(make_security_keys(path("keys/sender.key"), kGood), Error);
  EXPECT_THROW(make_security_keys(path("missing/keys"), kGood), Error);
  EXPECT_THROW(make_security_keys("", kGood), Error);
  EXPECT_THROW(make_security_keys(path("a <x>&"), kGood), Error) << "--security refuses such a path";
  EXPECT_EQ(read_file(path("keys/sender.key")), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "nothing is left over";
  fs::create_directory(path("empty"));
  make_security_keys(path("empty/"), kGood);
  EXPECT_EQ(mode(path("empty")), 0700);
}

TEST_F(SecurityKeys, NameTheProgramWhereItIsMissing) {
  setenv("PATH", folder_.c_str(), 1);
  EXPECT_THAT(fault(), AllOf(HasSubstr("openssl: program: found No such file"), HasSubstr("Debian: openssl")));
  EXPECT_THROW(make_security_keys(path("more"), kGood), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "nothing is left over";
}

TEST_F(SecurityKeys, HoldForTheirTime) {
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(fault(kGood.begin_s + 1), "");
  EXPECT_THAT(fault(kGood.begin_s - 1),
              AllOf(HasSubstr("/identity_ca.pem: certificate: found one that begins 2027-01-"),
                    HasSubstr("expected one that holds now")));
  EXPECT_THAT(fault(kGood.end_s + 1),
              HasSubstr("/identity_ca.pem: certificate: found one that expired 2027-01-16 "));
  make_security_keys(path("mixed"), kGood, {{"server", {kNow - kDay, kNow - 1}}});
  EXPECT_NO_THROW(security_configuration(path("mixed"), "sender", kNow));
  EXPECT_THROW(security_configuration(path("mixed"), "server", kNow), Error);
}

TEST_F(SecurityKeys, NameWhatIsWrong) {
  make_security_keys(path("others"), kGood);
  const auto other = [&](const std::string& name) { return read_file(path("others/") + name); };
  const auto own = [&](const std::string& name) { return read_file(path("keys/") + name); };
  EXPECT_THAT(
      fault_with("sender.key", own("server.key")),
      AllOf(HasSubstr("/sender.key: private key: found another one, expected that of "), HasSubstr("/sender.pem")));
  EXPECT_THAT(fault_with("sender.key", own("sender.pem")), HasSubstr("/sender.key: private key: found none"));
  EXPECT_THAT(fault_with("sender.pem", other("sender.pem")),
              HasSubstr("/sender.pem: certificate: found one of another"));
  EXPECT_THAT(fault_with("identity_ca.pem", other("identity_ca.pem")), HasSubstr("found one of another authority"));
  EXPECT_THAT(fault_with("sender.p7s", other("sender.p7s")),
              HasSubstr("/sender.p7s: signature: found none that fits"));
  EXPECT_THAT(fault_with("governance.p7s", other("governance.p7s")), HasSubstr("/governance.p7s: signature"));
  EXPECT_THAT(fault_with("permissions_ca.pem", other("permissions_ca.pem")),
              HasSubstr("/governance.p7s: signature"));
  std::string edited = own("sender.p7s");
  edited.replace(edited.find("DENY"), 4, "ALLOW");
  EXPECT_THAT(fault_with("sender.p7s", edited), HasSubstr("/sender.p7s: signature"));
  for (const char* name :
       {"identity_ca.pem", "permissions_ca.pem", "governance.p7s", "sender.pem", "sender.key", "sender.p7s"}) {
    for (const std::string& content : {std::string(), std::string("x"), std::string(100, '\0')})
      EXPECT_THAT(fault_with(name, content), HasSubstr(std::string("/keys/") + name + ": ")) << content.size();
    const std::string file = path("keys/") + name;
    fs::rename(file, path("away"));
    EXPECT_THAT(fault(), HasSubstr(std::string("/keys/") + name + ": ")) << "missing";
    fs::create_directory(file);
    EXPECT_THAT(fault(), HasSubstr(std::string("/keys/") + name + ": ")) << "a folder";
    fs::remove(file);
    fs::rename(path("away"), file);
  }
  EXPECT_EQ(fault(), "");
}

TEST_F(SecurityKeys, NameAFolderThatIsNone) {
  EXPECT_THROW(security_configuration(path("missing"), "sender", kNow), Error);
  EXPECT_THROW(security_configuration(path("keys/sender.pem"), "sender", kNow), Error);
  for (const char* name : {"a$b", "a&b", "a<b", "a\"b"}) {
    fs::rename(path("keys"), path(name));
    EXPECT_THROW(security_configuration(path(name), "sender", kNow), Error) << name;
    EXPECT_THROW(make_security_keys(path(std::string(name) + "/new"), kGood), Error) << "no keys that are refused";
    fs::rename(path(name), path("keys"));
  }
}

}  // namespace
}  // namespace glovebench
