// Outputs of the commands: names that come from files, and sets of files.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/file_set.h"
#include "eval/command_test.h"
#include "eval/test_program.h"
#include "render/label_renderer.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class OutputsLong : public CommandTest {
 protected:
  /// Valid except for the name of its set.
  void build_database(const std::string& set_name, const std::string& file) const {
    Workbench workbench(test_workbench());
    const PostureSet postures{set_name, {"open"}, {Posture::Zero()}};
    Database::build_file(path(file), postures, *workbench.model(), workbench.config().views,
                         render::label_renderer_factory(), 2, {}, kTinySizes);
  }
  ProgramRun run_with(const std::string& database, const std::string& output) const {
    return run_glovebench({"run", "--trajectory", path("good.json"), "--database", path(database), "-o",
                           path(output), "--robot-out", path(output) + "/robot"});
  }
};

TEST_F(OutputsLong, TheNameOfADatabaseLeadsOutOfNoFolder) {
  build_database("own", "own.glovedb");
  expect_fine(run_with("own.glovedb", "out"));
  const std::string commands = "good_own_source_subject1_gradient_1_seed1.jsonl";
  EXPECT_EQ(FileSet(path("out/robot")).read(commands), read_file(path("out/robot/") + commands)) << "one set";
  build_database("x/../../../escaped/evil", "evil.glovedb");
  for (const std::string& refused : {refusal(run_with("evil.glovedb", "a/b/c/out")),
                                     refusal(run_glovebench({"db", "info", path("evil.glovedb")}))})
    EXPECT_THAT(refused, HasSubstr("evil.glovedb: name: found \"x/../../../escaped/evil\""));
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("escaped")));
}

TEST_F(OutputsLong, TheNameOfASuiteLeadsOutOfNoFolder) {
  run_trajectory("good.json", "out");
  json results = json::parse(read_file(path("out/results.json")));
  results["suite"] = "../../evil";
  write_file(path("evil/results.json"), results.dump());
  EXPECT_THAT(refusal(run_glovebench({"gate", path("evil"), "--update"})),
              HasSubstr("suite: found \"../../evil\""));
}

TEST_F(OutputsLong, ARunThatIsNotWhatItsManifestSaysIsIncomplete) {
  run_trajectory("good.json", "out");
  const auto compare = [&] { return run_glovebench({"compare", path("out"), path("out/results.json")}); };
  EXPECT_EQ(compare().exit_code, 0);
  const std::string results = read_file(path("out/results.json"));
  std::string changed = results;
  changed.replace(changed.find("gradient"), 8, "kinect\"  ");
  for (const std::string& other : {changed, results.substr(0, results.size() / 2)}) {
    write_file(path("out/results.json"), other);
    const ProgramRun run = compare();
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.err, AllOf(HasSubstr("out/results.json: content"), HasSubstr("manifest.json says")));
  }
  // As after a kill between the manifest and the last file.
  write_file(path("out/.staged/results.json"), results);
  EXPECT_EQ(compare().exit_code, 0);
  fs::remove(path("out/manifest.json"));
  EXPECT_EQ(refusal(compare()), refusal(compare())) << "without a manifest it is read as it is: half a file";
  write_file(path("out/results.json"), results);
  EXPECT_EQ(compare().exit_code, 0) << "a run of before there were manifests";
}

TEST_F(OutputsLong, AFolderOfAnotherKindKeepsItsFiles) {
  run_trajectory("good.json", "out");
  const std::string page = read_file(path("out/index.html"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"compare", path("out"), path("out"), "-o", path("out")},
        {"gate", path("out"), "--baseline", path("out"), "-o", path("out")}})
    EXPECT_THAT(refusal(run_glovebench(command)), HasSubstr("which holds a run or a baseline"));
  EXPECT_EQ(read_file(path("out/index.html")), page);
  write_file(path("baseline/results.json"), read_file(path("out/results.json")));
  write_file(path("baseline/provenance.json"), "{}");
  EXPECT_THAT(refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o",
                                      path("baseline")})),
              HasSubstr("which holds a baseline"));
  // A recording has no file with the name of a run's file.
  render_recording("good.json", "out");
  expect_fine(run_glovebench({"compare", path("out"), path("out")}));
  expect_fine(track("out", "DB_open_power", "x.jsonl"));
}

}  // namespace
}  // namespace glovebench::eval
