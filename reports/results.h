#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/tracker/track_result.h"
#include "reports/commands.h"
#include "reports/metrics/metric.h"
#include "reports/statistics.h"
#include "reports/study.h"

namespace glovebench::reports {

/// One frame of a replay against the truth.
struct FrameRecord {
  int frame = 0;
  int64_t timestamp_us = 0;
  TrackStatus status = TrackStatus::no_hand;
  bool covered = false;        ///< tracked, and the error is under 50 mm and 30 degrees
  bool false_tracked = false;  ///< says tracked, and is not covered
  bool false_lost = false;     ///< says lost, though the hand was there to be tracked
  bool ambiguous = false;      ///< the matches' rotations spread over more than 60 degrees
  bool converged = false;      ///< of the alignment
  int icp_iterations = 0;

  /// One for each of frame_metrics(); empty where it cannot be told.
  std::vector<std::optional<double>> values = std::vector<std::optional<double>>(frame_metrics().size());
  std::optional<double>& operator[](std::string_view metric) { return values[metric_index(metric)]; }
  const std::optional<double>& operator[](std::string_view metric) const { return values[metric_index(metric)]; }

  friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};

enum class TruthKind { recorded, source };
constexpr auto names_of(TruthKind) {
  return std::to_array<std::string_view>({"recorded", "source"});
}
using glovebench::to_string;

struct NoiseSetting {
  std::string model = "gradient";  ///< name of a depth noise (`glovebench list noises`); "gradient" is the paper's
  double factor = 1;               ///< of the noise's gain

  friend bool operator==(const NoiseSetting&, const NoiseSetting&) = default;
};

/// What makes one experiment: one trajectory replayed against one database.
struct ExperimentKey {
  std::string trajectory;  ///< "Tr4"
  std::string database;    ///< "DB_open_power"
  TruthKind truth = TruthKind::recorded;
  int subject = 1;  ///< the hand in front of the camera: 1 is the tracker's own
  NoiseSetting noise;

  friend bool operator==(const ExperimentKey&, const ExperimentKey&) = default;
};
/// Names files: "Tr4_DB_open_power_recorded_subject1_gradient_1".
std::string to_string(const ExperimentKey& key);

/// The frames of one noise seed, consecutive ones of the trajectory.
struct SeedRun {
  uint64_t seed = 0;
  std::vector<FrameRecord> frames;

  friend bool operator==(const SeedRun&, const SeedRun&) = default;
};

/// How often the tracker had the hand; lost frames stay in the denominator.
struct Coverage {
  int frames = 0;
  int covered = 0;
  int lost = 0;
  int false_tracked = 0;
  int false_lost = 0;
  std::optional<double> share() const;  ///< covered / frames

  friend bool operator==(const Coverage&, const Coverage&) = default;
};

/// Of a whole sequence; empty where the trajectory has no hold or no movement to measure it on.
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
  // From here on: computed from the runs by `summarize`, but for what is handed to it.
  Coverage coverage;
  /// Both: one for each of frame_metrics(), over all frames and seeds that have the value.
  std::vector<Aggregate> aggregates = std::vector<Aggregate>(frame_metrics().size());
  std::vector<std::optional<ConfidenceInterval>> intervals =
      std::vector<std::optional<ConfidenceInterval>>(frame_metrics().size());  ///< of the means
  PckCurve pck;                                                                ///< of the joints' position errors
  SequenceMetrics sequence;
  std::optional<CommandResult> commands = {};  ///< empty in results from before they were measured

  const Aggregate& aggregate_of(std::string_view metric) const { return aggregates[metric_index(metric)]; }
  const std::optional<ConfidenceInterval>& interval_of(std::string_view metric) const {
    return intervals[metric_index(metric)];
  }
  friend bool operator==(const ExperimentResult&, const ExperimentResult&) = default;
};
/// Coverage, aggregates and intervals of the runs; the curve and the sequence's metrics are passed through.
ExperimentResult summarize(ExperimentKey key, std::vector<SeedRun> runs, PckCurve pck, SequenceMetrics sequence,
                           const BootstrapConfig& bootstrap = {});

/// How the numbers of a result are to be understood. Results are compared in the metrics that both have; all else
/// must be the same.
struct Protocol {
  int metric_definitions = 1;            ///< raised whenever a metric changes its meaning
  std::vector<std::string> joint_order;  ///< the 22 angles
  std::vector<std::string> metric_keys;  ///< of the frames; a file of another version may have others
  std::string association;               ///< how estimates meet truths, e.g. "by time stamp, exact"

  std::string id() const;  ///< hash of all of the above
  friend bool operator==(const Protocol&, const Protocol&) = default;
};
/// The protocol of this program.
Protocol make_protocol(std::string association);

/// Two results that say nothing about each other: of another protocol, truth, database, or other frames. The
/// message is that of an Error. The command line ends with exit code 3.
class Incomparable : public Error {
 public:
  using Error::Error;
};

/// Content hashes of what the experiments were made of. They stand beside the protocol, not in it, so that a part
/// of a run can be compared with the whole: experiments are comparable when their own truth and database are the
/// same.
struct InputHashes {
  std::map<std::string, std::string> truths;     ///< by truth_name
  std::map<std::string, std::string> databases;  ///< Database::content_hash, by the database's name
  std::string hand_model;                        ///< the tracker's
  std::string color_table;

  friend bool operator==(const InputHashes&, const InputHashes&) = default;
};
/// Names a truth among the inputs: "source/Tr4".
std::string truth_name(const ExperimentKey& key);

/// All that a run found, and nothing that differs when the same commit runs again.
struct RunResult {
  Protocol protocol;
  InputHashes inputs;
  std::string suite;  ///< the suite's name; empty if the run was of none
  std::string program_version;
  std::string commit;
  nlohmann::json configuration = nlohmann::json::object();  ///< effective
  std::vector<ExperimentResult> experiments;
  std::vector<StudyResult> studies;  ///< of a reproduction; empty for other runs

  friend bool operator==(const RunResult&, const RunResult&) = default;
};
/// The noise whose rows are Figure 4: the paper's (gradient x 1) if any experiment has it, else the first one's.
NoiseSetting headline_noise(const RunResult& result);
/// Null if there is no such experiment.
const ExperimentResult* find_experiment(const RunResult& result, const ExperimentKey& key);

}  // namespace glovebench::reports
