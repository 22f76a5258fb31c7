// DDS Security between processes: participants without the right are neither followed nor believed.
#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/adapters/dds/dds_sink.h"
#include "core/adapters/dds/measured_robot.h"
#include "core/adapters/dds/openssl.h"
#include "core/adapters/dds/security_keys.h"
#include "core/adapters/system_time.h"
#include "core/robot/test_commands.h"
#include "eval/dds/robot_server_fixture.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int64_t kDay = 86'400;

int64_t now_s() { return system_us() / 1'000'000; }
Validity valid_now() { return {now_s() - kDay, now_s() + kDay}; }

class DdsSecurity : public RobotServer {
 protected:
  void SetUp() override {
    RobotServer::SetUp();
    make_security_keys(path("keys"), valid_now());
    make_security_keys(path("strangers"), valid_now());
  }

  /// Settings of Cyclone DDS, valid or not.
  struct Files {
    std::string identity_ca, certificate, key, permissions_ca, governance, permissions;
  };
  Files files(const std::string& folder, const std::string& role) const {
    const std::string base = path(folder) + "/";
    return {base + "identity_ca.pem",    base + role + ".pem",    base + role + ".key",
            base + "permissions_ca.pem", base + "governance.p7s", base + role + ".p7s"};
  }
  /// For the probe, which makes no checks itself.
  static ProgramSetting as(const Files& files) {
    return {.environment = {
                {"CYCLONEDDS_URI",
                 fmt::format("{},<CycloneDDS><Domain><Security><Authentication><Library/><IdentityCA>file:{}"
                             "</IdentityCA><IdentityCertificate>file:{}</IdentityCertificate><PrivateKey>file:{}"
                             "</PrivateKey></Authentication><AccessControl><Library/><PermissionsCA>file:{}"
                             "</PermissionsCA><Governance>file:{}</Governance><Permissions>file:{}</Permissions>"
                             "</AccessControl><Cryptographic><Library/></Cryptographic></Security></Domain>"
                             "</CycloneDDS>",
                             getenv("CYCLONEDDS_URI"), files.identity_ca, files.certificate, files.key,
                             files.permissions_ca, files.governance, files.permissions)}}};
  }
  ProgramSetting as(const std::string& role) const { return as(files("keys", role)); }

  void openssl(const std::vector<std::string>& arguments, const std::string& input = "") const {
    const OpensslResult result = run_openssl(folder_, arguments, input);
    ASSERT_TRUE(result.is_success) << result.reason;
  }
  void sign_as_own(const std::string& file, const std::string& document) const {
    openssl({"smime", "-sign", "-text", "-signer", "own_ca.pem", "-inkey", "own.key", "-out", file}, document);
  }

  /// An observer with a valid identity that signed its own permissions.
  ProgramSetting as_presumptuous_observer() {
    openssl({"req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj",
             "/CN=its own", "-keyout", "own.key", "-out", "own_ca.pem"});
    const SecurityRole wanted = {"observer", {"*"}, {"*"}};
    sign_as_own("own_governance.p7s", governance_document());
    sign_as_own("own_rights.p7s", permissions_document(wanted, valid_now()));
    Files its = files("keys", "observer");
    its.permissions_ca = path("own_ca.pem");
    its.governance = path("own_governance.p7s");
    its.permissions = path("own_rights.p7s");
    return as(its);
  }
  ProgramSetting with_wrong_key(const std::string& role) const {
    Files its = files("keys", role);
    its.key = files("keys", "server").key;
    return as(its);
  }
  /// All who may not send what `role` sends.
  std::vector<std::pair<std::string, ProgramSetting>> intruders(const std::string& role) {
    return {{"unsecured", {}},
            {"a stranger", as(files("strangers", role))},
            {"a wrong private key", with_wrong_key(role)},
            {"an observer with rights of its own making", as_presumptuous_observer()}};
  }
  /// Access of a program that has the keys.
  DdsAccess access(const std::string& role) const { return {"", path("keys"), role}; }
};

TEST_F(DdsSecurity, OnlyTheSenderIsFollowed) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log, {"--security", path("keys")});
  const std::string wait = "sleep 500\n", more = "again 200 10000\n";  // does not wait: most have no listener
  std::vector<StartedProgram> running;
  for (const auto& [who, setting] : intruders("sender"))
    running.push_back(talk(wait + fingers(80, 1) + more, setting));
  for (const StartedProgram& intruder : running) EXPECT_EQ(finish(intruder).out, "said\n") << "nothing stops it";
  EXPECT_EQ(good(log, "fingers"), 0);
  const StartedProgram eavesdropper = listen();
  EXPECT_EQ(finish(talk(wait + fingers(10, 1) + more, as("sender"))).out, "said\n");
  ASSERT_GT(received(log, "fingers", "accepted"), 50) << "the same with the right keys is followed";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr(" accepted; "), testing::Not(HasSubstr("foreign"))));
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 10, 1e-6);
  EXPECT_EQ(stop(eavesdropper, SIGTERM).out, "ready\n") << "nobody without keys hears commands or states";
}

TEST_F(DdsSecurity, AnObserverHearsAndMaySendNothing) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log, {"--security", path("keys")});
  const StartedProgram observer = listen("1.5", as("observer"));
  ASSERT_TRUE(comes_true([&] { return !lines_of("states", said(observer)).empty(); }));
  for (const std::string& wrong :
       {fingers(80, 1), std::string("state states rh_FFJ3=1\n"), std::string("state measured rh_FFJ3=1\n")}) {
    const ProgramRun run = finish(talk(wrong, as("observer")));
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("dds_probe: writer: Not Allowed By Security"));
  }
  EXPECT_EQ(finish(talk("wait hand\n" + fingers(10, 1) + "again 60 10000\n", as("sender"))).out, "said\n");
  ASSERT_TRUE(comes_true([&] { return lines_of("hand", said(observer)).size() >= 61; }));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  EXPECT_EQ(good(log, "fingers"), 61);
}

TEST_F(DdsSecurity, StatesOfIntrudersAreNotBelieved) {
  std::string state;
  for (const std::string& name : hand_joint_names()) state += " " + name + "=0.1";
  const std::string tell = "state states" + state + "\nstate measured" + state + "\nagain 100000 10000\n";
  std::vector<StartedProgram> running;
  for (const auto& [who, setting] : intruders("robot")) running.push_back(talk(tell, setting));
  const DdsParticipant participant(std::stoi(domain_), access("sender"));
  MeasuredRobot robot(participant, {topics::kMeasuredJointStates}, true, false);
  EXPECT_THROW(robot.state(3), Error);
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log, {"--security", path("keys")});
  for (const StartedProgram& intruder : running) EXPECT_EQ(kill(intruder.process, 0), 0) << "it told all the time";
  for (const StartedProgram& intruder : running) stop(intruder, SIGKILL);
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, testing::Not(HasSubstr("another process tells")));
  talk("wait measured\nstate measured" + state + "\nagain 100000 10000\n", as("robot"));
  EXPECT_EQ(robot.state(20).hand, std::vector<double>(kShadowJointCount, 0.1)) << "the robot's are believed";
}

TEST_F(DdsSecurity, ACertificateThatExpiredIsNotFollowed) {
  constexpr int64_t kLifetime = 4;  // s
  const int64_t end_s = now_s() + kLifetime;
  make_security_keys(path("short"), valid_now(), {{"sender", {now_s() - kDay, end_s}}});
  const StartedProgram sender =
      talk("sleep 7000\n" + fingers(80, 1) + "again 300 10000\n", as(files("short", "sender")));
  while (now_s() <= end_s) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log, {"--security", path("short")});
  finish(sender);  // its keys were valid at the start, so only the server stops it
  EXPECT_EQ(good(log, "fingers"), 0);
  const ProgramRun late = finish(talk(fingers(80, 1), as(files("short", "sender"))));
  EXPECT_EQ(late.exit_code, 1) << "another one cannot even start";
  EXPECT_THAT(stop(server, SIGTERM).out, HasSubstr("hand: messages: none;"));
}

TEST_F(DdsSecurity, TheProgramSendsAndServesWithItsKeys) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log, {"--security", path("keys")});
  DdsSinkOptions options;
  options.access = access("sender");
  options.arm = false;
  DdsSink sink(std::stoi(domain_), options);
  ASSERT_TRUE(comes_true([&] { return sink.listeners() > 0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  for (int i = 0; i < 30; ++i) sink.send(good_command(1'000'000 + 33'333 * int64_t{i}));
  sink.finish();
  EXPECT_TRUE(comes_true([&] { return good(log, "fingers") == 30; }));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
}

TEST_F(DdsSecurity, KeysAreMadeOnceAndCheckedBeforeTheyAreUsed) {
  const std::string made = path("made");
  ProgramRun run = finish(start({build_paths::program("glovebench"), "robot-server", "keys", made, "--days", "2"}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, made + ": keys of sender server robot observer, for 2 days\n");
  const auto expect_refusal = [&](const ProgramRun& its, const std::string& what) {
    EXPECT_EQ(its.exit_code, 2) << what;
    EXPECT_EQ(std::ranges::count(its.err, '\n'), 1) << its.err;
    EXPECT_THAT(its.err, HasSubstr(what));
  };
  expect_refusal(finish(start({build_paths::program("glovebench"), "robot-server", "keys", made})),
                 "keys are not replaced");
  for (const char* days : {"0", "-1", "x", "1e9"})
    expect_refusal(
        finish(start({build_paths::program("glovebench"), "robot-server", "keys", path("no"), "--days", days})),
        "--days");
  const auto refusal_of = [&](const std::string& folder) {
    return finish(serve("hand", path("log"), {"--security", folder}));
  };
  expect_refusal(refusal_of(path("nothing")), "/nothing: folder: found No such file or directory");
  std::filesystem::copy_file(made + "/robot.key", made + "/server.key",
                             std::filesystem::copy_options::overwrite_existing);
  expect_refusal(refusal_of(made), "/made/server.key: private key: found another one, expected that of ");
  std::filesystem::remove(made + "/server.p7s");
  expect_refusal(refusal_of(made), "/made/server.p7s: ");
  make_security_keys(path("old"), {now_s() - 2 * kDay, now_s() - kDay});
  expect_refusal(refusal_of(path("old")), "/old/identity_ca.pem: certificate: found one that expired ");
  expect_refusal(
      finish(start({build_paths::program("glovebench"), "track", "--source", "fakenect:x", "--database",
                    "DB_open_power", "-o", path("e.jsonl"), "--robot", "dds:7", "--security", path("nothing")})),
      "/nothing: folder: ");
}

}  // namespace
}  // namespace glovebench::eval
