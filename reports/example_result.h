#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "reports/example_studies.h"
#include "reports/results.h"

namespace glovebench::reports {

inline FrameRecord example_frame(int index, double position_mm, double posture_deg, double rotation_deg) {
  FrameRecord frame;
  frame.frame = index;
  frame.timestamp_us = index * 1000000LL / 15;
  frame.status = TrackStatus::tracked;
  frame.covered = position_mm < 50 && rotation_deg < 30;
  frame.false_tracked = !frame.covered;
  frame.converged = true;
  frame.icp_iterations = 20;
  for (std::optional<double>& value : frame.values) value = posture_deg / 2;
  frame["position_error_mm"] = position_mm;
  frame["rotation_error_deg"] = rotation_deg;
  frame["posture_rms_deg"] = posture_deg;
  frame["posture_rms_hidden_deg"].reset();
  frame["vertex_error_mm"] = frame["joint_error_mm"] = position_mm * 1.25;
  frame["fingertip_error_mm"] = position_mm * 1.5;
  frame["visible_percent"] = 100;
  return frame;
}

inline FrameRecord example_lost_frame(int index) {
  FrameRecord frame;
  frame.frame = index;
  frame.timestamp_us = index * 1000000LL / 15;
  frame.status = TrackStatus::poor_match;
  frame.false_lost = true;
  frame["visible_percent"] = 100;
  return frame;
}

inline CommandResult example_commands(int frames, double error) {
  CommandResult commands;
  commands.frames = frames;
  commands.sent = {frames - 2, 2, 0};
  commands.rate_hz = 30;
  commands.longest_gap_ms = 33.333;
  commands.interventions.add(Intervention::hold, 2);
  commands.interventions.add(Intervention::arm_speed, 1);
  const std::vector<double> errors = {error, 2 * error};
  commands.errors = {aggregate(errors), aggregate(errors), aggregate(errors), {}};
  commands.jerk = {2e6, 150.5};
  commands.truth_jerk = {5e4, 8};
  return commands;
}

/// Four experiments: means 4 mm, 3 deg, 2 deg, one of four frames lost; all lost; no frames; another noise.
inline RunResult small_result() {
  RunResult result;
  result.protocol = make_protocol("by time stamp, exact");
  result.inputs = {{{"source/Tr1", "00ff"}, {"recorded/Tr4", "ff00"}, {"source/Tr4", "f0f0"}},
                   {{"DB_open_power", "0a"}, {"DB_20_postures", "0b"}},
                   "0c",
                   "0d"};
  result.program_version = "0.1.0";
  result.commit = "0123456789";
  result.configuration = {{"profile", "paper"}, {"icp", {{"max_points", 1000}}}};
  const PckCurve pck = pck_curve(std::vector<double>{1, 5, 30}, 4);
  const BootstrapConfig bootstrap = {.block_frames = 1, .resamples = 100};
  const ExperimentKey key = {"Tr4", "DB_open_power", TruthKind::recorded, 1, {}};
  std::vector<SeedRun> runs = {{1, {example_frame(0, 3, 2, 1), example_lost_frame(1)}},
                               {2, {example_frame(0, 4, 3, 2), example_frame(1, 5, 4, 3)}}};
  result.experiments.push_back(summarize(key, runs, pck, {0.5, 0.25, 3.0}, bootstrap));
  result.experiments.back().fingertip_pck = pck_curve(std::vector<double>{2, 10}, 4);
  result.experiments.back().commands = example_commands(4, 3);
  result.experiments.push_back(summarize({"Tr4", "DB_open_power", TruthKind::source, 2, {}},
                                         {{1, {example_lost_frame(0), example_lost_frame(1)}}}, pck_curve({}, 2),
                                         {}));
  result.experiments.push_back(
      summarize({"Tr1", "DB_20_postures", TruthKind::source, 1, {}}, {}, pck_curve({}, 0), {}));
  result.experiments.push_back(summarize({"Tr4", "DB_open_power", TruthKind::recorded, 1, {"kinect", 0.5}},
                                         {{1, {example_frame(0, 400, 2, 1)}}}, pck_curve({}, 1), {}));
  return result;
}

/// With posture jumps that decay.
inline std::vector<FrameRecord> example_frames(const std::string& name, uint64_t seed, int count, double level) {
  std::vector<FrameRecord> frames;
  RandomStream random(seed, name, 0, "example");
  double posture_deg = 1;
  for (int i = 0; i < count; ++i) {
    posture_deg = 0.75 * posture_deg + (i % 50 == 10 ? 25 : 0);
    if (i == 70 && level > 6)
      frames.push_back(example_lost_frame(i));
    else
      frames.push_back(example_frame(i, level + std::abs(random.normal()), posture_deg + level / 10,
                                     level / 2 + std::abs(random.normal())));
  }
  return frames;
}

inline RunResult full_result() {
  RunResult result = small_result();
  result.experiments.clear();
  result.inputs.databases = {
      {"DB_open_pinch", "0a"}, {"DB_open_power", "0b"}, {"DB_open_pinch_power", "0c"}, {"DB_20_postures", "0d"}};
  for (int t = 1; t <= 5; ++t) {
    const std::string trajectory = "Tr" + std::to_string(t);
    const int frames = t == 1 ? 137 : 117;
    result.inputs.truths["recorded/" + trajectory] = "ff00";
    result.inputs.truths["source/" + trajectory] = "f0f0";
    double level = 2;
    for (const char* database :
         {t <= 2 ? "DB_open_pinch" : "DB_open_power", "DB_open_pinch_power", "DB_20_postures"}) {
      for (const auto& [truth, subject] :
           {std::pair{TruthKind::recorded, 1}, {TruthKind::source, 1}, {TruthKind::source, 2}}) {
        level += 0.7;
        const ExperimentKey key = {trajectory, database, truth, subject, {}};
        const std::string name = to_string(key);
        std::vector<SeedRun> runs = {{1, example_frames(name, 1, frames, level)},
                                     {2, example_frames(name, 2, frames, level)}};
        std::vector<double> errors;
        for (const FrameRecord& frame : runs[0].frames)
          if (const auto& error = frame["joint_error_mm"]) errors.push_back(*error);
        result.experiments.push_back(summarize(key, std::move(runs), pck_curve(errors, frames), {0.4, 0.3, 2.9}));
        result.experiments.back().commands = example_commands(2 * frames, level);
      }
    }
  }
  result.studies = example_studies();
  return result;
}

inline void renew_protocol_id(nlohmann::json& protocol) {
  Protocol read = {protocol["metric_definitions"], protocol["joint_order"], protocol["metric_keys"],
                   protocol["association"]};
  if (protocol.contains("coverage_rules")) read.coverage_rules = protocol["coverage_rules"];
  protocol["id"] = read.id();
}

/// An unknown metric: 7.5 in each frame.
inline void add_metric(nlohmann::json& results, const std::string& key) {
  results["protocol"]["metric_keys"].push_back(key);
  renew_protocol_id(results["protocol"]);
  results["frame_columns"].push_back(key);
  for (nlohmann::json& experiment : results["experiments"]) {
    experiment["aggregates"][key] = {{"count", 0},     {"mean", nullptr}, {"median", nullptr},  {"rms", nullptr},
                                     {"p95", nullptr}, {"max", nullptr},  {"interval", nullptr}};
    for (nlohmann::json& run : experiment["runs"])
      for (nlohmann::json& frame : run["frames"]) frame.push_back(7.5);
  }
}

inline void remove_metric(nlohmann::json& results, const std::string& key) {
  nlohmann::json& columns = results["frame_columns"];
  const auto place = std::find(columns.begin(), columns.end(), key) - columns.begin();
  results["protocol"]["metric_keys"].erase(place - 9);
  renew_protocol_id(results["protocol"]);
  columns.erase(place);
  for (nlohmann::json& experiment : results["experiments"]) {
    experiment["aggregates"].erase(key);
    for (nlohmann::json& run : experiment["runs"])
      for (nlohmann::json& frame : run["frames"]) frame.erase(place);
  }
}

}  // namespace glovebench::reports
