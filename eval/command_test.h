#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "eval/test_program.h"

namespace glovebench::eval {

/// Has good.json (right hand) and left.json.
class CommandTest : public testing::Test {
 protected:
  static constexpr int kFrames = 4;

  void SetUp() override {
    folder_ = test_folder();
    write_file(path("good.json"), make_trajectory_json("good", kFrames).dump());
    nlohmann::json left = make_trajectory_json("left", kFrames);
    left["side"] = "left";
    write_file(path("left.json"), left.dump());
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  static void expect_fine(const ProgramRun& run) {
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.err, "") << "not even a message: stderr is no terminal";
  }
  static std::string refusal(const ProgramRun& run) {
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, testing::StartsWith("glovebench: "));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  }
  /// Returns results.json.
  nlohmann::json run_trajectory(const std::string& trajectory, const std::string& output,
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run",           "--trajectory", path(trajectory), "--database",
                                          "DB_open_power", "-o",           path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_fine(run_glovebench(arguments));
    return nlohmann::json::parse(read_file(path(output) + "/results.json"));
  }
  /// A cell of one of a report's tables; throws without it. `column`: its key.
  static nlohmann::json cell_of(const nlohmann::json& report, const std::string& study, const std::string& column,
                                size_t row = 0) {
    for (const nlohmann::json& each : report.at("studies")) {
      const nlohmann::json& table = each.at("tables").at(0);
      for (size_t c = 0; each.at("name") == study && c < table.at("columns").size(); ++c)
        if (table["columns"][c].at("key") == column) return table.at("rows").at(row).at(c);
    }
    throw std::runtime_error("no " + column + " in " + study);
  }
  ProgramRun track(const std::string& recording, const std::string& database, const std::string& output,
                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "track", "--source", "fakenect:" + path(recording), "--database", database, "-o", path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  void render_recording(const std::string& trajectory, const std::string& output) const {
    expect_fine(
        run_glovebench({"render", "--trajectory", path(trajectory), "--format", "fakenect", "-o", path(output)}));
  }

  std::string folder_;
};

}  // namespace glovebench::eval
