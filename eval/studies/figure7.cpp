#include "eval/studies/figure7.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/database/look_up.h"
#include "eval/program.h"
#include "eval/studies/sample.h"
#include "eval/studies/trial_queries.h"
#include "eval/terminal.h"
#include "eval/threads.h"
#include "eval/true_neighbor.h"
#include "render/label_renderer.h"
#include "reports/statistics.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Measure;
using reports::Table;

/// Entries that the look-up keeps by 16 px images (section IV-B).
constexpr double kPreselected = 500;

/// Results of one image size, one value per query.
struct SizeResult {
  int size = 0;                     ///< px
  std::vector<double> rank;         ///< of the true neighbor
  std::vector<double> distance_us;  ///< processor time per distance: all entries' time / entries
};

Database build_database(Workbench& workbench, const Figure7Setup& setup) {
  Progress progress("building the database of Figure 7", workbench.config().quiet);
  return Database::build(
      setup.postures, *workbench.model(), workbench.config().views, render::label_renderer_factory(),
      workbench.config().threads, [&](double share) { progress.show(share); }, setup.sizes);
}

/// On the calling thread alone, all sizes of a query in turn, so that a slow moment of the machine affects all
/// sizes.
std::vector<SizeResult> rank_all(const Database& database, const TrueNeighborSearch& search,
                                 const PinholeCamera& camera, std::span<const TrialQuery> queries,
                                 const Figure7Setup& setup, bool quiet) {
  Progress progress("ranking the entries of Figure 7", quiet);
  std::vector<SizeResult> results;
  for (const int size : setup.sizes) results.push_back({size, {}, {}});
  for (size_t q = 0; q < queries.size(); ++q) {
    const HandFrame& hand = queries[q].hand;
    const int neighbor = search.nearest(hand.posture, hand.T_camera_hand, camera).entry;
    for (size_t s = 0; s < results.size(); ++s) {
      const double start_us = 1000 * thread_time_ms();
      const std::vector<float> errors = distances(database, queries[q].images[s]);
      const double time_us = 1000 * thread_time_ms() - start_us;
      results[s].rank.push_back(rank_of(errors, neighbor));
      results[s].distance_us.push_back(time_us / database.entry_count());
    }
    progress.show(static_cast<double>(q + 1) / static_cast<double>(queries.size()));
  }
  return results;
}

double mean_of(const std::vector<double>& values, std::span<const int> drawn) {
  double sum = 0;
  for (const int q : drawn) sum += values[q];
  return sum / static_cast<double>(drawn.size());
}

constexpr const char* kQueries = "trial queries";

/// A step costs time if a distance takes 10% longer. Medians differ by up to 8% from run to run.
constexpr double kLeastGrowth = 1.1;

/// Number of steps to the next larger size in which the value moves in this direction.
template <typename Value, typename Compare>
int count_steps(const std::vector<SizeResult>& results, const Value& value, const Compare& moves) {
  int count = 0;
  for (size_t s = 1; s < results.size(); ++s) count += moves(value(results[s]), value(results[s - 1]));
  return count;
}

double percent_up_to(const std::vector<double>& ranks, double limit) {
  const auto count = std::ranges::count_if(ranks, [&](double rank) { return rank <= limit; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(ranks.size());
}

std::vector<Cell> row_of(const SizeResult& result) {
  const auto mean_rank = [&](std::span<const int> drawn) { return mean_of(result.rank, drawn); };
  const auto interval = interval_over(static_cast<int>(result.rank.size()), kQueries, mean_rank);
  return {"plain",
          int64_t{result.size},
          static_cast<int64_t>(result.rank.size()),
          reports::mean(result.rank).value(),
          interval->low,
          interval->high,
          reports::percentile(result.rank, 0.5).value(),
          percent_up_to(result.rank, 1),
          percent_up_to(result.rank, kPreselected),
          reports::percentile(result.distance_us, 0.5).value(),
          reports::percentile(result.distance_us, 0.95).value()};
}

std::string explanation_of(const Figure7Setup& setup, int entries, int redraws) {
  return fmt::format(
      "Rank of the true nearest neighbor when all {} entries are ordered by equation (2) over images of one size "
      "(1 "
      "is best; equal distances share their mean rank), and the processor time of one distance on one thread. The "
      "true neighbor is the entry with the smallest mean distance between equal vertices of its hand and the true "
      "one, both seen along the ray to the middle of their bounding square. The database has {} postures: {}. A "
      "query is a random blend of two of them with {:g} degrees of normal noise on each angle, under a uniformly "
      "random rotation, at a random place of a box of {:.0f} x {:.0f} x {:.0f} mm whose middle is {:.0f} mm ahead "
      "of the camera, rendered with the paper's gradient noise and passed through registration, segmentation and "
      "cloud; {} hands that the tracker would not look up were drawn again. The paper prints curves without "
      "numbers, and says neither which 8000 images and 500 queries it took nor what its true neighbor is.",
      entries, setup.postures.postures.size(), fmt::join(setup.postures.posture_names, ", "), kTrialAngleNoise_deg,
      2000 * kTrialReach[0], 2000 * kTrialReach[1], 2000 * kTrialReach[2], 1000 * kTrialDistance, redraws);
}

Table make_table(const std::vector<SizeResult>& results, std::string explanation) {
  Table table{"figure7",
              "Figure 7: rank of the true nearest neighbor and time of a distance, by the size of the tiny images",
              std::move(explanation),
              {{"implementation", "implementation"},
               {"size_px", "size (px)", 0},
               {"queries", "queries", 0},
               {"mean_rank", "mean rank", 1},
               {"mean_rank_low", "mean rank, low (95%)", 1},
               {"mean_rank_high", "mean rank, high (95%)", 1},
               {"median_rank", "median rank", 1},
               {"first_percent", "first (%)", 1},
               {"in_first_500_percent", "in the first 500 (%)", 1},
               {"distance_us", "time of one distance (us), median over queries", 3, true},
               {"distance_us_p95", "its 95th percentile", 3, true}},
              2,
              {}};
  for (const SizeResult& result : results) table.rows.push_back(row_of(result));
  return table;
}

std::vector<Measure> make_measures(const std::vector<SizeResult>& results, int redraws) {
  const auto queries = static_cast<int>(results.front().rank.size());
  const auto lower_rank = [&](std::span<const int> drawn) -> double {
    return count_steps(
        results, [&](const SizeResult& r) { return mean_of(r.rank, drawn); }, std::less<>());
  };
  const auto rank_ratio = [&](std::span<const int> drawn) {
    return mean_of(results.front().rank, drawn) / mean_of(results.back().rank, drawn);
  };
  const double higher_time = count_steps(
      results, [](const SizeResult& r) { return reports::percentile(r.distance_us, 0.5).value(); },
      [](double larger, double smaller) { return larger >= kLeastGrowth * smaller; });
  const std::string ratio_name =
      fmt::format("figure7.mean_rank_{}px_over_{}px", results.front().size, results.back().size);
  return {measure_over(queries, kQueries, "figure7.steps_with_lower_rank", "", lower_rank),
          {"figure7.steps_with_higher_time", "", higher_time, std::nullopt, true},
          measure_over(queries, kQueries, ratio_name, "", rank_ratio),
          {"figure7.redrawn_queries", "", static_cast<double>(redraws), std::nullopt}};
}

}  // namespace

Figure7Setup figure7_setup(bool quick) {
  PostureSet postures = trajectories::posture_set(trajectory_folder(), "DB_20_postures");
  const size_t count = quick ? 3 : 11;
  postures.name = fmt::format("DB_{}_postures", count);
  postures.posture_names.resize(count);
  postures.postures.resize(count);
  if (quick) return {std::move(postures), {8, 16, 32, 64}, 40};
  return {std::move(postures), {8, 12, 16, 24, 32, 48, 64}, 500};
}

double rank_of(std::span<const float> errors, int entry) {
  int less = 0, equal = 0;
  for (const float error : errors) {
    less += error < errors[entry];
    equal += error == errors[entry];
  }
  return less + (equal + 1) / 2.0;
}

reports::StudyResult measure_figure7(const StudyContext& context, const Figure7Setup& setup) {
  check(setup.sizes.size() >= 2 && setup.queries >= 2, "Figure 7 compares sizes over queries");
  Workbench& workbench = context.workbench;
  const Database database = build_database(workbench, setup);
  const std::vector<TrialQuery> queries =
      make_trial_queries(workbench, context.options.tracker, setup.postures, setup.sizes,
                         context.options.seeds.front(), setup.queries);
  int redraws = 0;
  for (const TrialQuery& query : queries) redraws += query.redraws;
  const std::shared_ptr<const HandModel> model = workbench.model();
  const TrueNeighborSearch search(*model, database);
  const std::vector<SizeResult> results =
      rank_all(database, search, workbench.calibration().ir, queries, setup, workbench.config().quiet);
  return {"fig7",
          "Figure 7: tiny images",
          {make_table(results, explanation_of(setup, database.entry_count(), redraws))},
          make_measures(results, redraws)};
}

reports::StudyResult run_figure7(const StudyContext& context) {
  return measure_figure7(context, figure7_setup(context.options.quick));
}

}  // namespace glovebench::eval
