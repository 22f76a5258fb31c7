#pragma once

// For tests: results with other metrics.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/results.h"

namespace glovebench::reports {

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
