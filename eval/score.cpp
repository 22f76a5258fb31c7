#include "eval/score.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "eval/estimates/estimate_doubts.h"
#include "eval/estimates/time_match.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

std::vector<EstimateSequence> sequences_of(const ScoreRequest& request) {
  std::vector<EstimateSequence> sequences = load_estimates(request.estimates, request.format, request.flags);
  if (request.beside.empty()) return sequences;
  return {merged(sequences.front(), load_estimates(request.beside, "", request.flags).front(), request.beside)};
}

double ms_of(double us) { return us / 1000; }

std::string sentence(const TimeMatch& match, int64_t tolerance_us) {
  const size_t frames = match.answers.size(), found = frames - static_cast<size_t>(match.missing);
  std::string text = fmt::format("{} of {} have an estimate", found, reports::counted(frames, "frame"));
  if (!match.is_exact) text += fmt::format(" within {:.1f} ms", ms_of(static_cast<double>(tolerance_us)));
  if (match.unmatched > 0)
    text += fmt::format("; {} match no frame", reports::counted(match.unmatched, "estimate"));
  return text + ".";
}

nlohmann::json parts_json(const EstimateSequence& sequence) {
  const EstimateParts& has = sequence.has;
  return {{"posture", has.posture},
          {"pose", has.pose},
          {"joints", has.hand() ? size_t{kForearmJoint} : sequence.joints.size()},
          {"place", has.place},
          {"scale", has.scale}};
}

/// What is the same for all sequences of a file.
struct Scoring {
  const ScoreRequest& request;
  const PointComparison comparison;
  const std::vector<Points> true_points;
  int64_t tolerance_us = 0;
};

int64_t offset_us(const Scoring& scoring, const EstimateSequence& sequence, Score& score) {
  const ScoreRequest& request = scoring.request;
  if (!request.estimates_offset) return std::llround(1000 * request.offset_ms);
  const TimeOffset offset = estimate_offset(scoring.comparison, frames_of(request.spec), scoring.true_points,
                                            sequence, request.estimates);
  score.matches.push_back(
      fmt::format("Time offset: {:.1f} ms, 95% interval {:.1f} to {:.1f} (bootstrap over seconds).",
                  ms_of(offset.offset_us), ms_of(offset.low_us), ms_of(offset.high_us)));
  return std::llround(offset.offset_us);
}

void add_run(const Scoring& scoring, const EstimateSequence& sequence, const std::vector<Sight>& seen,
             Score& score) {
  const ScoreRequest& request = scoring.request;
  const std::span<const HandFrame> truth = frames_of(request.spec);
  const int64_t offset = offset_us(scoring, sequence, score);
  const TimeMatch match = match_times(truth, sequence, offset, scoring.tolerance_us, request.estimates);
  score.matches.push_back(sentence(match, scoring.tolerance_us));
  if (!match.is_exact)
    score.plan.association =
        fmt::format("by time stamp, nearest within {} ms", ms_of(static_cast<double>(scoring.tolerance_us)));
  score.plan.score["offsets_ms"].push_back(ms_of(static_cast<double>(offset)));
  if (const auto doubt =
          estimate_doubt(scoring.comparison, truth, scoring.true_points, match.answers, sequence.order);
      doubt && score.plan.score["warnings"].empty())
    score.plan.score["warnings"].push_back(*doubt);
  RunSpec spec = request.spec;
  spec.seed = sequence.seed;
  score.plan.specs.push_back(spec);
  std::vector<double> no_times(seen.size());
  score.runs.push_back({spec, match.answers, seen, {}, std::move(no_times)});
}

}  // namespace

Score score(Workbench& workbench, const ScoreRequest& request) {
  std::vector<EstimateSequence> sequences = sequences_of(request);
  const EstimateSequence& first = sequences.front();
  if (sequences.size() == 1) sequences.front().seed = request.spec.seed;
  const std::shared_ptr<const HandModel> hand = workbench.model();
  const std::span<const HandFrame> truth = frames_of(request.spec);
  const PointComparison comparison{first.has, first.joints, hand.get()};
  const auto tolerance_us =
      request.tolerance_ms ? std::llround(1000 * *request.tolerance_ms) : default_tolerance_us(truth);
  const Scoring scoring{request, comparison, points_of(comparison, truth, workbench.subject(request.spec.subject)),
                        tolerance_us};
  Score result;
  result.plan.tracker = request.spec.tracker;
  result.plan.score = {{"file", std::filesystem::path(request.estimates).filename().string()},
                       {"hash", hash_file(request.estimates)},
                       {"has", parts_json(first)},
                       {"tolerance_ms", ms_of(static_cast<double>(tolerance_us))},
                       {"offsets_ms", nlohmann::json::array()},
                       {"warnings", nlohmann::json::array()}};
  const std::vector<Sight> seen = see(workbench, request.spec);
  for (const EstimateSequence& sequence : sequences) add_run(scoring, sequence, seen, result);
  return result;
}

}  // namespace glovebench::eval
