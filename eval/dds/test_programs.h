#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <sstream>
#include <string>
#include <vector>

#include "ci/build_paths.h"
#include "core/adapters/dds/test_peers.h"
#include "eval/test_program.h"

namespace glovebench::eval {

class DdsBus : public testing::Test {
 protected:
  void SetUp() override {
    use_loopback_dds();
    folder_ = test_folder();
  }
  void TearDown() override {
    for (const StartedProgram& program : running_) {
      kill(program.process, SIGKILL);
      finish_program(program);
    }
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  StartedProgram start(const std::vector<std::string>& command, const ProgramSetting& setting = {}) {
    running_.push_back(start_program(command, setting));
    return running_.back();
  }
  ProgramRun finish(const StartedProgram& program) {
    std::erase_if(running_, [&](const StartedProgram& other) { return other.process == program.process; });
    return finish_program(program);
  }
  ProgramRun stop(const StartedProgram& program, int signal) {
    kill(program.process, signal);
    return finish(program);
  }

  /// Prints messages until `seconds` pass without one (longer for the first).
  StartedProgram listen(const std::string& seconds = "1.5", const ProgramSetting& setting = {}) {
    const StartedProgram listener = start({build_paths::program("dds_probe"), "listen", domain_, seconds}, setting);
    EXPECT_TRUE(comes_true([&] { return said(listener).find("ready") != std::string::npos; }));
    return listener;
  }
  StartedProgram talk(const std::string& script, const ProgramSetting& setting = {}) {
    const std::string file = path("script-" + std::to_string(scripts_++));
    write_file(file, script);
    return start({build_paths::program("dds_probe"), "talk", domain_, file}, setting);
  }
  static std::string said(const StartedProgram& program) {
    return std::filesystem::exists(program.out) ? read_file(program.out) : "";
  }

  static std::vector<std::string> lines_of(const std::string& topic, const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);)
      if (line.starts_with(topic + " ")) lines.push_back(line);
    return lines;
  }

  std::string folder_;
  std::string domain_ = "7";
  std::vector<StartedProgram> running_;
  int scripts_ = 0;
};

}  // namespace glovebench::eval
