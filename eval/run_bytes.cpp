#include "eval/run_bytes.h"

#include <array>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/base/parse_json.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using reports::Cell;
using reports::Column;
using reports::ConfidenceInterval;
using reports::Measure;
using reports::StageTiming;
using reports::StudyResult;
using reports::Table;

/// Stored members of a struct, in the order of the bytes; null for other types.
template <typename T>
constexpr auto kFields = nullptr;
template <>
constexpr auto kFields<Match> = std::tuple(&Match::entry, &Match::error);
template <>
constexpr auto kFields<AngleCertainty> = std::tuple(&AngleCertainty::deviation, &AngleCertainty::hidden);
template <>
constexpr auto kFields<EstimateParts> = std::tuple(&EstimateParts::posture, &EstimateParts::pose,
                                                   &EstimateParts::place, &EstimateParts::scale,
                                                   &EstimateParts::internals);
template <>
constexpr auto kFields<TrackResult> = std::tuple(
    &TrackResult::timestamp_us, &TrackResult::status, &TrackResult::posture, &TrackResult::T_camera_hand,
    &TrackResult::posture_unfiltered, &TrackResult::T_camera_hand_unfiltered, &TrackResult::T_camera_hand_coarse,
    &TrackResult::matches, &TrackResult::ambiguous, &TrackResult::converged, &TrackResult::cloud_points,
    &TrackResult::icp_points, &TrackResult::icp_iterations, &TrackResult::icp_residual, &TrackResult::certainty,
    &TrackResult::reason, &TrackResult::has, &TrackResult::joints);
template <>
constexpr auto kFields<Sight> = std::tuple(&Sight::visible_pixels, &Sight::trackable, &Sight::visible_percent);
template <>
constexpr auto kFields<StageTiming> = std::tuple(&StageTiming::stage, &StageTiming::frame_ms);
template <>
constexpr auto kFields<Column> = std::tuple(&Column::key, &Column::heading, &Column::digits, &Column::is_time);
template <>
constexpr auto kFields<Table> = std::tuple(&Table::name, &Table::title, &Table::explanation, &Table::name_columns,
                                           &Table::columns, &Table::rows);
template <>
constexpr auto kFields<ConfidenceInterval> = std::tuple(&ConfidenceInterval::low, &ConfidenceInterval::high,
                                                        &ConfidenceInterval::level, &ConfidenceInterval::seeds,
                                                        &ConfidenceInterval::blocks,
                                                        &ConfidenceInterval::block_frames,
                                                        &ConfidenceInterval::over);
template <>
constexpr auto kFields<Measure> = std::tuple(&Measure::name, &Measure::unit, &Measure::value, &Measure::interval,
                                             &Measure::is_time);
template <>
constexpr auto kFields<StudyResult> = std::tuple(&StudyResult::name, &StudyResult::title, &StudyResult::tables,
                                                 &StudyResult::measures);

template <typename T>
concept Struct = !std::is_null_pointer_v<std::remove_const_t<decltype(kFields<T>)>>;
template <typename T>
concept Optional = requires(T value) {
  value.has_value();
};
template <typename T>
concept Vector = std::is_same_v<T, Posture> || std::is_same_v<T, Eigen::Vector3d>;
template <typename T>
concept Integer = std::is_integral_v<T> && !std::is_same_v<T, bool>;
/// A list that the JSON library does not convert by itself.
template <typename T>
concept List = requires(T list) {
  list.push_back(list.front());
}
&&!std::is_arithmetic_v<typename T::value_type>;

template <typename T>
json to_row(const T& value) {
  if constexpr (Struct<T>) {
    return std::apply([&](auto... field) { return json::array({to_row(value.*field)...}); }, kFields<T>);
  } else if constexpr (Optional<T>) {
    return value ? to_row(*value) : json();
  } else if constexpr (Named<T>) {
    return to_string(value);
  } else if constexpr (Vector<T>) {
    return std::vector<double>(value.begin(), value.end());
  } else if constexpr (std::is_same_v<T, Eigen::Isometry3d>) {  // the upper three rows, column by column
    const Eigen::Matrix<double, 3, 4> upper = value.matrix().template topRows<3>();
    return std::vector<double>(upper.data(), upper.data() + upper.size());
  } else if constexpr (std::is_same_v<T, Cell>) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* count = std::get_if<int64_t>(&value)) return *count;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    return {};
  } else if constexpr (List<T>) {
    json rows = json::array();
    for (const auto& each : value) rows.push_back(to_row(each));
    return rows;
  } else {
    return value;
  }
}

/// The JSON library would convert any number, also one that does not fit.
template <Integer T>
T integer_of(const json& row) {
  const bool fits = row.is_number_unsigned() ? std::in_range<T>(row.get<uint64_t>())
                                             : row.is_number_integer() && std::in_range<T>(row.get<int64_t>());
  if (!fits) throw json::other_error::create(501, "no integer of this size", &row);
  return row.get<T>();
}

template <typename T>
T from_row(const json& row) {
  if constexpr (Struct<T>) {
    T value;
    size_t i = 0;
    const auto read = [&](auto& member) {
      member = from_row<std::remove_reference_t<decltype(member)>>(row.at(i++));
    };
    std::apply([&](auto... field) { (read(value.*field), ...); }, kFields<T>);
    return value;
  } else if constexpr (Optional<T>) {
    return row.is_null() ? T() : T(from_row<typename T::value_type>(row));
  } else if constexpr (Named<T>) {
    const std::optional<T> value = from_name<T>(row.get<std::string>());
    if (!value) throw json::other_error::create(501, "no such name", &row);
    return *value;
  } else if constexpr (Vector<T>) {
    return T::Map(row.get<std::array<double, T::SizeAtCompileTime>>().data());
  } else if constexpr (std::is_same_v<T, Eigen::Isometry3d>) {
    T pose = T::Identity();
    pose.matrix().template topRows<3>() =
        Eigen::Matrix<double, 3, 4>::Map(row.get<std::array<double, 12>>().data());
    return pose;
  } else if constexpr (std::is_same_v<T, Cell>) {
    if (row.is_string()) return row.get<std::string>();
    if (row.is_number_integer()) return integer_of<int64_t>(row);
    if (row.is_number()) return row.get<double>();
    return {};
  } else if constexpr (List<T>) {
    T list;
    for (const json& each : row) list.push_back(from_row<typename T::value_type>(each));
    return list;
  } else if constexpr (Integer<T>) {
    return integer_of<T>(row);
  } else {
    return row.get<T>();
  }
}

std::string cbor_of(const json& content) {
  std::string bytes;
  json::to_cbor(content, bytes);
  return bytes;
}

/// Empty for bytes that `read` refuses.
template <typename Read>
auto from_cbor(const std::string& bytes, const char* where, const Read& read)
    -> std::invoke_result_t<Read, const json&> {
  try {
    return read(parse_cbor(bytes, where));
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::string to_bytes(const Run& run) {
  return cbor_of({{"answers", to_row(run.answers)},
                  {"seen", to_row(run.seen)},
                  {"stages", to_row(run.stages)},
                  {"frame_ms", run.frame_ms}});
}

std::optional<Run> run_from_bytes(const std::string& bytes, const RunSpec& spec) {
  return from_cbor(bytes, "stored run", [&](const json& object) -> std::optional<Run> {
    Run run{spec, from_row<std::vector<TrackResult>>(object.at("answers")),
            from_row<std::vector<Sight>>(object.at("seen")),
            from_row<std::vector<StageTiming>>(object.at("stages")),
            object.at("frame_ms").get<std::vector<double>>()};
    const size_t frames = run.answers.size();
    if (run.seen.size() != frames || run.frame_ms.size() != frames) return std::nullopt;
    return run;
  });
}

std::string to_bytes(const StudyResult& study) { return cbor_of(to_row(study)); }

std::optional<StudyResult> study_from_bytes(const std::string& bytes) {
  return from_cbor(bytes, "stored study",
                   [](const json& row) -> std::optional<StudyResult> { return from_row<StudyResult>(row); });
}

}  // namespace glovebench::eval
