#include "eval/run_bytes.h"

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/parse_json.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using reports::Cell;
using reports::Column;
using reports::ConfidenceInterval;
using reports::Measure;
using reports::StudyResult;
using reports::Table;

json row_of(const Posture& posture) { return std::vector<double>(posture.begin(), posture.end()); }

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

json row_of(const EstimateParts& has) { return {has.posture, has.pose, has.place, has.scale, has.internals}; }

std::optional<Eigen::Vector3d> joint_of(const json& row) {
  if (row.is_null()) return std::nullopt;
  return Eigen::Vector3d(row.at(0).get<double>(), row.at(1).get<double>(), row.at(2).get<double>());
}

json row_of(const TrackResult& r) {
  json matches = json::array(), joints = json::array();
  for (const Match& match : r.matches) matches.push_back({match.entry, match.error});
  for (const auto& p : r.joints) joints.push_back(p ? json{p->x(), p->y(), p->z()} : json());
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
          r.certainty ? json{row_of(r.certainty->deviation), r.certainty->hidden} : json(),
          r.reason,
          row_of(r.has),
          std::move(joints)};
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
  r.reason = row.at(15).get<std::string>();
  const json& has = row.at(16);
  r.has = {has.at(0), has.at(1), has.at(2), has.at(3), has.at(4)};
  for (const json& joint : row.at(17)) r.joints.push_back(joint_of(joint));
  return r;
}

json row_of(const Sight& sight) { return {sight.visible_pixels, sight.trackable, sight.visible_percent}; }

Sight sight_of(const json& row) { return {row.at(0).get<std::array<int, kPatchCount>>(), row.at(1), row.at(2)}; }

json row_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<int64_t>(&cell)) return *count;
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  return {};
}

Cell cell_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.get<int64_t>();
  if (value.is_number()) return value.get<double>();
  return {};
}

json row_of(const Table& table) {
  json columns = json::array(), rows = json::array();
  for (const Column& column : table.columns)
    columns.push_back({column.key, column.heading, column.digits, column.is_time});
  for (const std::vector<Cell>& row : table.rows) {
    json& cells = rows.emplace_back(json::array());
    for (const Cell& cell : row) cells.push_back(row_of(cell));
  }
  return {table.name, table.title, table.explanation, table.name_columns, std::move(columns), std::move(rows)};
}

Table table_of(const json& row) {
  Table table{row.at(0), row.at(1), row.at(2), {}, row.at(3), {}};
  for (const json& column : row.at(4))
    table.columns.push_back({column.at(0), column.at(1), column.at(2), column.at(3)});
  for (const json& cells : row.at(5)) {
    std::vector<Cell>& cells_of_row = table.rows.emplace_back();
    for (const json& value : cells) cells_of_row.push_back(cell_of(value));
  }
  return table;
}

json row_of(const Measure& measure) {
  json interval;
  if (const auto& i = measure.interval)
    interval = {i->low, i->high, i->level, i->seeds, i->blocks, i->block_frames, i->over};
  return {measure.name, measure.unit, measure.value ? json(*measure.value) : json(), interval, measure.is_time};
}

Measure measure_of(const json& row) {
  Measure measure{row.at(0), row.at(1), {}, {}, row.at(4)};
  if (!row.at(2).is_null()) measure.value = row.at(2).get<double>();
  if (const json& i = row.at(3); !i.is_null())
    measure.interval = ConfidenceInterval{i.at(0), i.at(1), i.at(2), i.at(3), i.at(4), i.at(5), i.at(6)};
  return measure;
}

}  // namespace

std::string to_bytes(const Run& run) {
  json answers = json::array(), seen = json::array(), stages = json::array();
  for (const TrackResult& answer : run.answers) answers.push_back(row_of(answer));
  for (const Sight& sight : run.seen) seen.push_back(row_of(sight));
  for (const reports::StageTiming& stage : run.stages) stages.push_back({stage.stage, stage.frame_ms});
  std::string bytes;
  json::to_cbor({{"answers", std::move(answers)},
                 {"seen", std::move(seen)},
                 {"stages", std::move(stages)},
                 {"frame_ms", run.frame_ms}},
                bytes);
  return bytes;
}

std::optional<Run> run_from_bytes(const std::string& bytes, const RunSpec& spec) {
  try {
    const json object = parse_cbor(bytes, "stored run");
    Run run;
    run.spec = spec;
    for (const json& row : object.at("answers")) run.answers.push_back(result_of(row));
    for (const json& row : object.at("seen")) run.seen.push_back(sight_of(row));
    for (const json& stage : object.at("stages"))
      run.stages.push_back({stage.at(0).get<std::string>(), stage.at(1).get<std::vector<double>>()});
    run.frame_ms = object.at("frame_ms").get<std::vector<double>>();
    const size_t frames = run.answers.size();
    if (run.seen.size() != frames || run.frame_ms.size() != frames) return std::nullopt;
    return run;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string to_bytes(const StudyResult& study) {
  json tables = json::array(), measures = json::array();
  for (const Table& table : study.tables) tables.push_back(row_of(table));
  for (const Measure& measure : study.measures) measures.push_back(row_of(measure));
  std::string bytes;
  json::to_cbor(json{study.name, study.title, std::move(tables), std::move(measures)}, bytes);
  return bytes;
}

std::optional<StudyResult> study_from_bytes(const std::string& bytes) {
  try {
    const json content = parse_cbor(bytes, "stored study");
    StudyResult study{content.at(0), content.at(1), {}, {}};
    for (const json& table : content.at(2)) study.tables.push_back(table_of(table));
    for (const json& measure : content.at(3)) study.measures.push_back(measure_of(measure));
    return study;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace glovebench::eval
