#include "core/adapters/process/process_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "core/adapters/process/tracker_answer.h"
#include "core/adapters/process/tracker_process.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/hand/skeleton.h"
#include "core/tracker/smoothing.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr int kNotExecutable = 126, kNotFound = 127;  // a shell's exit codes

class ProcessMethod : public Method {
 public:
  ProcessMethod(const MethodInputs& inputs, const ProcessLimits& limits)
      : command_(inputs.config.method.substr(kProgramPrefix.size())),
        start_line_(start_line(inputs.calibration, *inputs.model)),
        disparity_(inputs.calibration.disparity),
        limits_(limits),
        starts_left_(limits.restarts + 1) {
    if (command_.find_first_not_of(' ') == std::string::npos)
      throw Error("--method", "command", "none", "exec:COMMAND");
  }

  /// The way of one frame: start the program if none runs, send the frame, wait for the answer, read it.
  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                    const StageObserver& observe) override {
    observe(Stage::answer);
    TrackResult result;
    try {
      const std::string answer = exchange(frame);
      result = parse_answer(answer, number_);
      if (result.status == TrackStatus::tracked) refuse_other_parts(result);
    } catch (const ProgramEnded& e) {
      refuse_if_unknown(e.exit_code);
      lose(result, previous, e);
    } catch (const Error& e) {
      lose(result, previous, e);
    }
    ++number_;
    result.timestamp_us = frame.depth_timestamp_us;
    constexpr SmoothingConfig kUnfiltered = {0, 0, 1};
    return smoothed(std::move(result), previous, kUnfiltered);
  }

 private:
  /// Means over frames need the same metrics in each.
  void refuse_other_parts(const TrackResult& result) {
    const auto has = [&](int joint) { return !result.joints.empty() && result.joints[joint].has_value(); };
    const std::array<bool, 5> parts = {result.has.posture, result.has.pose, !result.joints.empty(),
                                       has(kWristJoint), has(kMiddleMcpJoint)};
    if (!parts_) parts_ = parts;
    if (parts != *parts_) throw Error("an answer with other parts than the first");
  }

  /// The next frame starts the program again.
  void lose(TrackResult& result, std::span<const TrackResult> previous, const Error& why) {
    if (program_) program_->kill();
    program_.reset();
    result.has = previous.empty() ? EstimateParts{.internals = false} : previous.back().has;
    result.status = TrackStatus::missing;
    result.reason = why.what();
  }

  /// Throws: Error if the shell did not find a program for the first frame.
  void refuse_if_unknown(int exit_code) const {
    if (number_ > 0 || (exit_code != kNotFound && exit_code != kNotExecutable)) return;
    throw Error("--method", "command", fmt::format("{}: exit code {}", quoted_excerpt(command_), exit_code),
                "a command that /bin/sh can start");
  }

  std::string exchange(const DeviceFrame& frame) {
    const bool is_new = !program_;
    if (is_new) start();
    const std::string line = frame_line(number_, frame);
    const std::vector<uint16_t> depth = depth_units(frame, disparity_);
    const std::string_view parts[] = {is_new ? start_line_ : std::string_view(), line, bytes_of(depth),
                                      bytes_of(frame.color)};
    const auto deadline = TrackerProcess::Clock::now() + (is_new ? limits_.first_frame : limits_.frame);
    return program_->exchange(parts, deadline);
  }

  void start() {
    if (starts_left_ == 0) throw Error("the program failed too often to be started again");
    --starts_left_;
    program_.emplace(command_);
  }

  template <typename Pixels>
  static std::string_view bytes_of(const Pixels& pixels) {
    return {reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof(*pixels.data())};
  }

  std::string command_;
  std::string start_line_;
  OptionalLine disparity_;
  ProcessLimits limits_;
  int starts_left_;
  int number_ = 0;                            ///< of the next frame
  std::optional<std::array<bool, 5>> parts_;  ///< of the first answer
  std::optional<TrackerProcess> program_;
};

/// Words between blanks. What stands in quotation marks is one word.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  for (size_t at = 0; (at = command.find_first_not_of(' ', at)) != std::string::npos;) {
    const bool is_quoted = command[at] == '\'' || command[at] == '"';
    if (is_quoted) ++at;
    const size_t end = std::min(command.find(is_quoted ? command[at - 1] : ' ', at), command.size());
    words.push_back(command.substr(at, end - at));
    at = std::min(end + 1, command.size());
  }
  return words;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Empty if PATH has no such program.
std::string found_in_path(const std::string& name) {
  const char* search = std::getenv("PATH");
  std::istringstream folders(search == nullptr ? "" : search);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path path = fs::path(folder) / name; is_file(path)) return path.string();
  return "";
}

}  // namespace

std::unique_ptr<Method> make_process_method(const MethodInputs& inputs, const ProcessLimits& limits) {
  return std::make_unique<ProcessMethod>(inputs, limits);
}

std::string program_hash(const std::string& method) {
  const std::vector<std::string> words = words_of(method.substr(kProgramPrefix.size()));
  nlohmann::json content = nlohmann::json::array({method});
  for (const std::string& word : words) {
    if (is_file(word)) content.push_back({word, hash_file(word)});
    const std::string program = word.find('/') == std::string::npos ? found_in_path(word) : "";
    if (&word == &words.front() && !program.empty()) content.push_back({program, hash_file(program)});
  }
  return hash_text(content.dump());
}

}  // namespace glovebench
