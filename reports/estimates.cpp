#include "reports/estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "core/hand/posture.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr size_t kFirstNumber = 4;  // after seed, frame, time stamp, status
constexpr size_t kPosition = kFirstNumber, kQuaternion = kPosition + 3, kAngles = kQuaternion + 4;
constexpr size_t kColumnCount = kAngles + kAngleCount;

const std::vector<std::string>& columns() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = {"seed",          "frame",         "timestamp_us",  "status",
                                      "position_x_mm", "position_y_mm", "position_z_mm", "quaternion_w",
                                      "quaternion_x",  "quaternion_y",  "quaternion_z"};
    for (const AngleInfo& info : angle_infos()) names.push_back(fmt::format("{}_deg", info.name));
    return names;
  }();
  return all;
}

/// Millimeters and degrees have six decimals; parts of a quaternion nine, for the same 1e-6 degrees.
std::string number_text(size_t column, double value) {
  const bool is_quaternion = column >= kQuaternion && column < kAngles;
  return nlohmann::json(is_quaternion ? std::round(value * 1e9) / 1e9 + 0.0 : rounded(value)).dump();
}

}  // namespace

std::string estimates_heading() { return fmt::format("{}", fmt::join(columns(), ",")); }

std::string estimate_csv_line(const Estimate& estimate) {
  std::string line =
      fmt::format("{},{},{},{}", estimate.seed, estimate.frame, estimate.timestamp_us, to_string(estimate.status));
  if (estimate.status != TrackStatus::tracked) return line + std::string(kColumnCount - kFirstNumber, ',');
  const Eigen::Vector3d position_mm = estimate.T_camera_hand.translation() * 1000;
  Eigen::Quaterniond q(estimate.T_camera_hand.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();  // q and -q are the same rotation; always writes the one with w >= 0
  size_t column = kPosition;
  const auto add = [&](double value) { line.append(1, ',').append(number_text(column++, value)); };
  for (const double value : position_mm) add(value);
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) add(value);
  for (const double angle : estimate.posture) add(degrees_from_radians(angle));
  return line;
}

namespace {

/// One line of the file, read strictly.
class Line {
 public:
  Line(std::string_view text, const std::string& where, int number) : where_(where), number_(number) {
    for (size_t begin = 0; begin <= text.size();) {
      const size_t end = std::min(text.find(',', begin), text.size());
      if (count_ < kColumnCount) cells_[count_] = text.substr(begin, end - begin);
      ++count_;
      begin = end + 1;
    }
    if (count_ != kColumnCount) {
      throw Error(where_, fmt::format("line {}", number_), fmt::format("{} columns", count_),
                  std::to_string(kColumnCount));
    }
  }

  std::string_view operator[](size_t column) const { return cells_[column]; }

  template <typename Number>
  Number whole(size_t column) const {
    const std::string_view cell = cells_[column];
    const std::optional<Number> value = number_in<Number>(cell);
    if (!value || std::to_string(*value) != cell) fail(column, "a whole number");
    return *value;
  }

  /// Accepts numbers as estimates_csv writes them, up to `largest`.
  double number(size_t column, double largest) const {
    const std::string_view cell = cells_[column];
    const std::optional<double> value = number_in<double>(cell);
    if (!value || !(std::abs(*value) <= largest) || number_text(column, *value) != cell)
      fail(column, fmt::format("a number as `run` writes it, up to {}", largest));
    return *value;
  }

  [[noreturn]] void fail(size_t column, const std::string& expected) const {
    // A damaged cell may be long and contain anything, but the message must be one short line.
    const std::string found =
        nlohmann::json(cells_[column].substr(0, 40)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    throw Error(where_, fmt::format("line {}, column {}", number_, columns()[column]), found, expected);
  }

 private:
  const std::string& where_;
  int number_;
  size_t count_ = 0;
  std::array<std::string_view, kColumnCount> cells_;
};

Eigen::Quaterniond read_rotation(const Line& line) {
  constexpr double kRounding = 1e-5;  // as of four components written to 1e-6, as before
  const auto component = [&](size_t i) { return line.number(kQuaternion + i, 1); };
  const Eigen::Quaterniond q(component(0), component(1), component(2), component(3));
  if (std::abs(q.norm() - 1) > kRounding || q.w() < 0) line.fail(kQuaternion, "a quaternion of length 1, w >= 0");
  return q.normalized();
}

Estimate read_line(const Line& line) {
  constexpr double kLargest_mm = 1e6, kLargest_deg = 360;
  Estimate estimate;
  estimate.seed = line.whole<uint64_t>(0);
  estimate.frame = line.whole<int>(1);
  estimate.timestamp_us = line.whole<int64_t>(2);
  const std::optional<TrackStatus> status = from_name<TrackStatus>(line[3]);
  if (!status) line.fail(3, "a frame's status");
  estimate.status = *status;
  if (*status != TrackStatus::tracked) {
    for (size_t column = kFirstNumber; column < kColumnCount; ++column)
      if (!line[column].empty()) line.fail(column, "nothing, since the frame is lost");
    return estimate;
  }
  Eigen::Vector3d position;
  for (int i = 0; i < 3; ++i) position[i] = line.number(kPosition + i, kLargest_mm) / 1000;
  estimate.T_camera_hand = Eigen::Translation3d(position) * read_rotation(line);
  for (int i = 0; i < kAngleCount; ++i)
    estimate.posture[i] = radians_from_degrees(line.number(kAngles + i, kLargest_deg));
  return estimate;
}

/// Checks that a seed's frames are consecutive and that no seed occurs twice.
void check_order(const Line& line, const std::vector<Estimate>& before, const Estimate& estimate,
                 std::set<uint64_t>& seeds) {
  if (estimate.frame < 0) line.fail(1, "0 or more");
  if (before.empty() || before.back().seed != estimate.seed) {
    if (!seeds.insert(estimate.seed).second) line.fail(0, "each seed once");
    return;
  }
  if (estimate.frame - 1 != before.back().frame) line.fail(1, std::to_string(int64_t{before.back().frame} + 1));
  if (estimate.timestamp_us <= before.back().timestamp_us)
    line.fail(2, fmt::format("more than {}", before.back().timestamp_us));
}

}  // namespace

std::string estimates_file(const ExperimentKey& key) { return fmt::format("estimates/{}.csv", to_string(key)); }

std::string estimates_csv(const ExperimentEstimates& estimates) {
  std::string csv = estimates_heading() + "\n";
  for (const Estimate& estimate : estimates.estimates) csv += estimate_csv_line(estimate) + "\n";
  return csv;
}

std::vector<Estimate> read_estimates(const std::string& path) {
  return parse_estimates(read_file(path, kLargestResults), path);
}

std::vector<Estimate> parse_estimates(const std::string& text, const std::string& where) {
  std::vector<Estimate> estimates;
  // An estimate is larger than its line may be, so this reserves no more than the lines that could be valid.
  const auto lines = static_cast<size_t>(std::ranges::count(text, '\n'));
  estimates.reserve(std::min(lines, text.size() / kColumnCount));
  std::set<uint64_t> seeds;
  int number = 0;
  for (size_t begin = 0; begin < text.size() || number == 0;) {
    const size_t end = text.find('\n', begin);
    ++number;
    if (end == std::string::npos) throw Error(where, fmt::format("line {}", number), "no line end", "a whole line");
    const Line line(std::string_view(text).substr(begin, end - begin), where, number);
    begin = end + 1;
    if (number == 1) {
      for (size_t column = 0; column < kColumnCount; ++column)
        if (line[column] != columns()[column]) line.fail(column, columns()[column]);
      continue;
    }
    const Estimate estimate = read_line(line);
    check_order(line, estimates, estimate, seeds);
    estimates.push_back(estimate);
  }
  return estimates;
}

std::optional<HandFrame> find_hand(const std::vector<Estimate>& estimates, uint64_t seed, int frame) {
  for (const Estimate& estimate : estimates)
    if (estimate.seed == seed && estimate.frame == frame && estimate.status == TrackStatus::tracked)
      return HandFrame{estimate.timestamp_us, estimate.posture, estimate.T_camera_hand};
  return std::nullopt;
}

}  // namespace glovebench::reports
