#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/hand/posture.h"
#include "core/tracker/track_result.h"
#include "reports/commands.h"
#include "reports/metrics/metric.h"
#include "reports/statistics.h"
#include "reports/study.h"

namespace glovebench::reports {

struct FrameRecord {
  int frame = 0;
  int64_t timestamp_us = 0;
  TrackStatus status = TrackStatus::no_hand;
  bool is_judged = true;       ///< false: no pose, so the next two are unknown
  bool covered = false;        ///< tracked within 50 mm and 30 degrees
  bool false_tracked = false;  ///< tracked, but not covered
  bool false_lost = false;     ///< lost, though trackable
  bool ambiguous = false;      ///< two matches' rotations differ by more than 60 degrees
  bool converged = false;
  int icp_iterations = 0;

  /// In the order of frame_metrics(). Empty where unknown.
  std::vector<std::optional<double>> values = std::vector<std::optional<double>>(frame_metrics().size());
  std::optional<double>& operator[](std::string_view metric) { return values[metric_index(metric)]; }
  const std::optional<double>& operator[](std::string_view metric) const { return values[metric_index(metric)]; }

  friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};

enum class TruthKind { recorded, source };
constexpr auto names_of(TruthKind) { return std::to_array<std::string_view>({"recorded", "source"}); }
using glovebench::to_string;

struct NoiseSetting {
  std::string model = "gradient";  ///< as in `glovebench list noises`
  double factor = 1;               ///< of the noise's gain

  friend bool operator==(const NoiseSetting&, const NoiseSetting&) = default;
};

struct ExperimentKey {
  std::string trajectory;  ///< "Tr4"
  std::string database;    ///< "DB_open_power"
  TruthKind truth = TruthKind::recorded;
  int subject = 1;  ///< rendered hand; 1: the tracker's
  NoiseSetting noise;
  Appearance appearance = Appearance::glove;

  friend bool operator==(const ExperimentKey&, const ExperimentKey&) = default;
};
/// "Tr4_DB_open_power_recorded_subject1_gradient_1"; of a bare hand "..._subject1-skin_gradient_1".
std::string to_string(const ExperimentKey& key);

/// Consecutive frames under one noise seed.
struct SeedRun {
  uint64_t seed = 0;
  std::vector<FrameRecord> frames;

  friend bool operator==(const SeedRun&, const SeedRun&) = default;
};

/// Lost frames stay in the denominator. coverage.h defines visible, found and usable.
struct Coverage {
  int frames = 0;
  std::optional<int> covered = 0;  ///< empty, like others below, if estimates lack what they need
  int lost = 0;
  std::optional<int> false_tracked = 0;
  int false_lost = 0;
  int visible = 0;                             ///< 0 in older results
  std::optional<int> found = 0;                ///< visible and covered
  std::optional<int> usable = 0;               ///< visible and usable
  std::optional<double> share() const;         ///< covered / frames
  std::optional<double> found_share() const;   ///< found / visible
  std::optional<double> usable_share() const;  ///< usable / visible

  friend bool operator==(const Coverage&, const Coverage&) = default;
};

/// Empty where the trajectory never rests or moves.
struct SequenceMetrics {
  std::optional<double> jitter_position_mm;
  std::optional<double> jitter_rotation_deg;
  std::optional<double> latency_frames;

  friend bool operator==(const SequenceMetrics&, const SequenceMetrics&) = default;
};

Coverage count_coverage(const std::vector<SeedRun>& runs);

struct ExperimentResult {
  ExperimentKey key;
  std::vector<SeedRun> runs;
  Coverage coverage;
  /// In the order of frame_metrics(), over all frames and seeds with a value.
  std::vector<Aggregate> aggregates = std::vector<Aggregate>(frame_metrics().size());
  std::vector<std::optional<ConfidenceInterval>> intervals =
      std::vector<std::optional<ConfidenceInterval>>(frame_metrics().size());  ///< of the means
  PckCurve pck;                                                                ///< of joint position errors
  SequenceMetrics sequence;
  std::optional<PckCurve> fingertip_pck = {};  ///< empty in older results
  std::optional<CommandResult> commands = {};  ///< empty in older results

  const Aggregate& aggregate_of(std::string_view metric) const { return aggregates[metric_index(metric)]; }
  const std::optional<ConfidenceInterval>& interval_of(std::string_view metric) const {
    return intervals[metric_index(metric)];
  }
  friend bool operator==(const ExperimentResult&, const ExperimentResult&) = default;
};
ExperimentResult summarize(ExperimentKey key, std::vector<SeedRun> runs, PckCurve pck, SequenceMetrics sequence,
                           const BootstrapConfig& bootstrap = {});

/// Results are comparable if these are equal, except metric_keys.
struct Protocol {
  int metric_definitions = 1;  ///< increases when a metric changes its meaning
  std::vector<std::string> joint_order;
  std::vector<std::string> metric_keys;               ///< columns
  std::string association;                            ///< estimates to truths: "by time stamp, exact"
  std::map<std::string, double> coverage_rules = {};  ///< metrics/coverage.h; empty in older results

  std::string id() const;  ///< hash of the above
  friend bool operator==(const Protocol&, const Protocol&) = default;
};
Protocol make_protocol(std::string association);

/// Results of different protocol, truth, database or frames (exit code 3).
class Incomparable : public Error {
 public:
  using Error::Error;
};

struct InputHashes {
  std::map<std::string, std::string> truths;     ///< by truth_name
  std::map<std::string, std::string> databases;  ///< content_hash by name
  std::string hand_model;                        ///< the tracker's
  std::string color_table;

  friend bool operator==(const InputHashes&, const InputHashes&) = default;
};
/// "source/Tr4".
std::string truth_name(const ExperimentKey& key);

struct RunResult {
  Protocol protocol;
  InputHashes inputs;
  std::string suite;  ///< empty: none
  std::string program_version;
  std::string commit;
  nlohmann::json configuration = nlohmann::json::object();
  std::vector<ExperimentResult> experiments;
  std::vector<StudyResult> studies;

  friend bool operator==(const RunResult&, const RunResult&) = default;
};
/// "COMMIT-HASH", a hash of all that determines the results.
std::string run_name(const RunResult& result);
/// The paper's noise (gradient x 1) if an experiment has it, else the first one's.
NoiseSetting headline_noise(const RunResult& result);
/// Null if absent.
const ExperimentResult* find_experiment(const RunResult& result, const ExperimentKey& key);

}  // namespace glovebench::reports
