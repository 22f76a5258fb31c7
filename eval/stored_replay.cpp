#include "eval/stored_replay.h"

#include "core/base/error.h"
#include "core/base/parse_json.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;

json row_of(const Posture& posture) {
  return std::vector<double>(posture.begin(), posture.end());
}

Posture posture_of(const json& row) {
  const auto values = row.get<std::array<double, kAngleCount>>();
  return Posture::Map(values.data());
}

/// The upper three rows of the matrix, column by column.
json row_of(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix<double, 3, 4> upper = pose.matrix().topRows<3>();
  return std::vector<double>(upper.data(), upper.data() + upper.size());
}

Eigen::Isometry3d pose_of(const json& row) {
  const auto values = row.get<std::array<double, 12>>();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix().topRows<3>() = Eigen::Matrix<double, 3, 4>::Map(values.data());
  return pose;
}

json row_of(const TrackResult& r) {
  json matches = json::array();
  for (const Match& match : r.matches) matches.push_back({match.entry, match.error});
  return {r.timestamp_us,
          to_string(r.status),
          row_of(r.posture),
          row_of(r.T_camera_hand),
          row_of(r.posture_unfiltered),
          row_of(r.T_camera_hand_unfiltered),
          row_of(r.T_camera_hand_coarse),
          std::move(matches),
          r.ambiguous,
          r.converged,
          r.cloud_points,
          r.icp_points,
          r.icp_iterations,
          r.icp_residual,
          r.certainty ? json{row_of(r.certainty->deviation), r.certainty->hidden} : json()};
}

TrackStatus status_of(const json& value) {
  const std::optional<TrackStatus> status = from_name<TrackStatus>(value.get<std::string>());
  if (!status) throw json::other_error::create(501, "no status", &value);
  return *status;
}

TrackResult result_of(const json& row) {
  TrackResult r;
  r.timestamp_us = row.at(0);
  r.status = status_of(row.at(1));
  r.posture = posture_of(row.at(2));
  r.T_camera_hand = pose_of(row.at(3));
  r.posture_unfiltered = posture_of(row.at(4));
  r.T_camera_hand_unfiltered = pose_of(row.at(5));
  r.T_camera_hand_coarse = pose_of(row.at(6));
  for (const json& match : row.at(7)) r.matches.push_back({match.at(0).get<int>(), match.at(1).get<float>()});
  r.ambiguous = row.at(8);
  r.converged = row.at(9);
  r.cloud_points = row.at(10);
  r.icp_points = row.at(11);
  r.icp_iterations = row.at(12);
  r.icp_residual = row.at(13);
  if (const json& certainty = row.at(14); !certainty.is_null())
    r.certainty = {posture_of(certainty.at(0)), certainty.at(1).get<uint32_t>()};
  return r;
}

json row_of(const reports::FrameErrors& errors) {
  const reports::FrameRecord& r = errors.record;
  json values = json::array();
  for (const std::optional<double>& value : r.values) values.push_back(value ? json(*value) : json());
  return {r.frame,     r.timestamp_us, to_string(r.status), r.covered,         r.false_tracked,       r.false_lost,
          r.ambiguous, r.converged,    r.icp_iterations,    std::move(values), errors.joint_errors_mm};
}

reports::FrameErrors errors_of(const json& row) {
  reports::FrameErrors errors;
  reports::FrameRecord& r = errors.record;
  r.frame = row.at(0);
  r.timestamp_us = row.at(1);
  r.status = status_of(row.at(2));
  r.covered = row.at(3);
  r.false_tracked = row.at(4);
  r.false_lost = row.at(5);
  r.ambiguous = row.at(6);
  r.converged = row.at(7);
  r.icp_iterations = row.at(8);
  const json& values = row.at(9);
  if (values.size() != r.values.size()) throw json::other_error::create(501, "other metrics", &row);
  for (size_t m = 0; m < values.size(); ++m)
    if (!values[m].is_null()) r.values[m] = values[m].get<double>();
  errors.joint_errors_mm = row.at(10).get<std::vector<double>>();
  return errors;
}

json object_of(const TrackedReplay& replay) {
  json results = json::array(), errors = json::array(), stages = json::array();
  for (const TrackResult& result : replay.results) results.push_back(row_of(result));
  for (const reports::FrameErrors& frame : replay.errors) errors.push_back(row_of(frame));
  for (const reports::StageTiming& stage : replay.stages) stages.push_back({stage.stage, stage.frame_ms});
  return {{"database", replay.database},
          {"results", std::move(results)},
          {"errors", std::move(errors)},
          {"stages", std::move(stages)},
          {"frame_ms", replay.frame_ms}};
}

TrackedReplay replay_of(const json& object) {
  TrackedReplay replay;
  replay.database = object.at("database");
  for (const json& row : object.at("results")) replay.results.push_back(result_of(row));
  for (const json& row : object.at("errors")) replay.errors.push_back(errors_of(row));
  for (const json& stage : object.at("stages")) {
    replay.stages.push_back({stage.at(0).get<std::string>(), stage.at(1).get<std::vector<double>>()});
  }
  replay.frame_ms = object.at("frame_ms").get<std::vector<double>>();
  return replay;
}

}  // namespace

std::string to_bytes(const std::vector<TrackedReplay>& replay) {
  json passes = json::array();
  for (const TrackedReplay& pass : replay) passes.push_back(object_of(pass));
  std::string bytes;
  json::to_cbor(passes, bytes);
  return bytes;
}

std::optional<std::vector<TrackedReplay>> replay_from_bytes(const std::string& bytes) {
  try {
    std::vector<TrackedReplay> replay;
    for (const json& pass : parse_cbor(bytes, "stored replay")) replay.push_back(replay_of(pass));
    return replay;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace glovebench::eval
