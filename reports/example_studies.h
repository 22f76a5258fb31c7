#pragma once

#include <string>
#include <vector>

#include "reports/paper_numbers.h"
#include "reports/study.h"

namespace glovebench::reports {

inline StudyResult example_figure7() {
  Table table = {"figure7",
                 "Tiny images: time of one distance, and rank of the true neighbor",
                 "Rank 1 is the first. The plain implementation follows the paper.",
                 {{"implementation", "implementation", 0},
                  {"size_px", "size px", 0},
                  {"queries", "queries", 0},
                  {"mean_rank", "mean rank", 2},
                  {"mean_rank_low", "low", 2},
                  {"mean_rank_high", "high", 2},
                  {"median_rank", "median rank", 1},
                  {"first_percent", "first %", 1},
                  {"in_first_500_percent", "in first 500 %", 1},
                  {"distance_us", "distance us", 3, true},
                  {"distance_us_p95", "distance us, p95", 3, true}},
                 2,
                 {}};
  for (const std::string implementation : {"plain", "fast"}) {
    for (const int64_t size : {8, 16, 32, 64}) {
      const double rank = 1 + 4000.0 / static_cast<double>(size * size);
      const double time = static_cast<double>(size * size) / (implementation == "plain" ? 1000.0 : 50000.0);
      table.rows.push_back({implementation, size, int64_t{500}, rank, rank * 0.9, rank * 1.1, 1.0, 100 / rank,
                            size == 64 ? Cell(100.0) : Cell(), time, time * 1.2});
    }
  }
  return {"fig7",
          "Figure 7: tiny images",
          {table},
          {{"figure7.steps_with_lower_rank", "", 6, ConfidenceInterval{5, 6, 0.95, 1, 34, 15, "queries"}, false},
           {"figure7.steps_with_higher_time", "", 6, {}, true}}};
}

inline StudyResult example_figure8() {
  Table table = {"figure8",
                 "Matching cascades",
                 "Mean errors over all trajectories of the database; times of one frame, one thread.",
                 {{"database", "database", 0},
                  {"cascade", "cascade", 0},
                  {"implementation", "implementation", 0},
                  {"truth", "truth", 0},
                  {"frames", "frames", 0},
                  {"posture_error_deg", "posture deg", 2},
                  {"posture_error_deg_low", "low", 2},
                  {"posture_error_deg_high", "high", 2},
                  {"position_error_mm", "position mm", 2},
                  {"rotation_error_deg", "rotation deg", 2},
                  {"true_neighbor_survives_percent", "true neighbor survives %", 1},
                  {"look_up_ms_p50", "look-up ms, p50", 2, true},
                  {"look_up_ms_p95", "p95", 2, true},
                  {"look_up_ms_p99", "p99", 2, true},
                  {"frame_ms_p50", "frame ms, p50", 2, true},
                  {"frame_ms_p95", "p95", 2, true},
                  {"frame_ms_p99", "p99", 2, true},
                  {"paper_posture_error_deg", "paper posture deg", 2},
                  {"paper_time_ms", "paper ms", 1}},
                 4,
                 {}};
  for (const std::string implementation : {"plain", "fast"}) {
    for (const PaperCascade& paper : paper_numbers().figure_8) {
      const double posture = paper.posture_error_deg * 0.8 + 1.0 / 3;
      const double look_up = paper.time_ms / (implementation == "plain" ? 4 : 200);
      table.rows.push_back({paper.database, to_string(paper.cascade), implementation, "source", int64_t{585},
                            posture, posture * 0.95, posture * 1.05, 4.25, 2.0 / 3,
                            paper.cascade.front().size == 8 ? Cell() : Cell(98.76), look_up, look_up * 1.1,
                            look_up * 1.3, look_up + 12, look_up + 14, look_up + 21, paper.posture_error_deg,
                            paper.time_ms});
    }
  }
  return {"fig8",
          "Figure 8: matching cascades",
          {table},
          {{"figure8.posture_change_deg", "deg", 0.16,
            ConfidenceInterval{0.01, 0.31, 0.95, 1, 40, 15, "blocks of frames of these movements, one noise seed"},
            false},
           {"figure8.time_share", "", 0.5115, {}, true},
           {"figure8.tiny_posture_excess_deg", "deg", 10.4, {}, false},
           {"figure8.tiny_time_share", "", 1.02, {}, true}}};
}

/// With empty cells, an inconclusive and a broken claim.
inline std::vector<StudyResult> example_studies() { return {example_figure7(), example_figure8()}; }

}  // namespace glovebench::reports
