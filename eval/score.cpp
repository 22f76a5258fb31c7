#include "eval/score.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/base/hash.h"
#include "core/base/math.h"
#include "eval/estimates/capture_alignment.h"
#include "eval/estimates/estimate_doubts.h"
#include "eval/estimates/time_match.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

std::vector<EstimateSequence> sequences_of(const ScoreRequest& request) {
  std::vector<EstimateSequence> sequences = load_estimates(request.estimates, request.format, request.flags);
  if (!request.beside.empty())
    sequences = {
        merged(sequences.front(), load_estimates(request.beside, "", request.flags).front(), request.beside)};
  if (sequences.front().joints.empty() && !(request.flags.frame.empty() && request.flags.order.joints.empty()))
    throw Error(request.estimates, "estimates", "no joints", "joints, since --frame or --joints is given");
  return sequences;
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

constexpr const char* kWithoutConstant =
    "errors do not include a constant offset or rotation between camera and capture: the alignment removed it";

/// Times are relative to the start of the recording, so that its device's clock does not matter.
double offset_from_start_us(const CaptureRequest& request, double offset_us) {
  return offset_us + static_cast<double>(request.answers.front().timestamp_us);
}

nlohmann::json alignment_json(const CaptureRequest& request, const CaptureAlignment& alignment) {
  const auto rounded_ms = [&](double us) { return reports::rounded(ms_of(offset_from_start_us(request, us))); };
  nlohmann::json transform = nlohmann::json::array();
  for (const double value : pose_numbers(alignment.T_camera_capture)) transform.push_back(reports::rounded(value));
  return {{"start_in_capture_ms", rounded_ms(alignment.time.offset_us)},
          {"start_in_capture_interval_ms", {rounded_ms(alignment.time.low_us), rounded_ms(alignment.time.high_us)}},
          {"camera_capture", std::move(transform)},
          {"camera_capture_95_mm", reports::rounded(1000 * alignment.position_95)},
          {"camera_capture_95_deg", reports::rounded(degrees_from_radians(alignment.rotation_95))},
          {"residual_mm", reports::rounded(1000 * alignment.residual)},
          {"frames", alignment.used},
          {"left_out", alignment.left_out}};
}

std::vector<std::string> sentences(const CaptureRequest& request, const CaptureAlignment& alignment,
                                   const CapturedTruth& truth) {
  const auto start_ms = [&](double us) { return ms_of(offset_from_start_us(request, us)); };
  const std::array<double, 7> T = pose_numbers(alignment.T_camera_capture);
  return {
      fmt::format("{} of {} lie in the capture.", truth.frames.size(),
                  reports::counted(request.answers.size(), "frame")),
      fmt::format("Start of the recording: {:.1f} ms after that of the capture, 95% interval {:.1f} to {:.1f} "
                  "(bootstrap over seconds).",
                  start_ms(alignment.time.offset_us), start_ms(alignment.time.low_us),
                  start_ms(alignment.time.high_us)),
      fmt::format("Capture in the camera's frame: {:.4f} {:.4f} {:.4f} m, quaternion {:.5f} {:.5f} {:.5f} {:.5f}; "
                  "95%: {:.2f} mm at the hand, {:.2f} degrees.",
                  T[0], T[1], T[2], T[3], T[4], T[5], T[6], 1000 * alignment.position_95,
                  degrees_from_radians(alignment.rotation_95)),
      fmt::format("Residual of the alignment: {:.2f} mm over {}, {} farther off left out.",
                  1000 * alignment.residual, reports::counted(alignment.used, "frame"), alignment.left_out),
      request.spec.trajectory->description.empty()
          ? std::string("The capture does not say how far its truth is off.")
          : fmt::format("The truth is off by the residual of its markers: {}.",
                        request.spec.trajectory->description)};
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

Score score_against_capture(Workbench& workbench, const CaptureRequest& request) {
  const std::span<const HandFrame> capture = frames_of(request.spec);
  const CaptureAlignment alignment = align_to_capture(
      capture, request.answers, workbench.subject(request.spec.subject), *workbench.model(), request.recording);
  CapturedTruth truth = captured_truth(capture, request.answers, alignment, request.recording);
  auto movement = std::make_shared<trajectories::Trajectory>(*request.spec.trajectory);
  movement->frames = std::move(truth.frames);
  RunSpec spec = request.spec;
  spec.trajectory = movement;
  Score result;
  result.matches = sentences(request, alignment, {movement->frames, {}});
  result.plan.tracker = spec.tracker;
  result.plan.specs = {spec};
  result.plan.association = "by time stamp, offset estimated, truth interpolated and aligned";
  result.plan.score = {{"recording", request.recording},
                       {"capture", request.spec.trajectory->description},
                       {"alignment", alignment_json(request, alignment)},
                       {"warnings", nlohmann::json::array({kWithoutConstant})}};
  std::vector<Sight> seen = see(workbench, spec);
  std::vector<double> no_times(seen.size());
  result.runs.push_back({spec, std::move(truth.answers), std::move(seen), {}, std::move(no_times)});
  return result;
}

}  // namespace glovebench::eval
