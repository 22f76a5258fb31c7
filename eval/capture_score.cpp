#include "eval/capture_score.h"

#include <fmt/format.h>

#include "core/base/math.h"
#include "eval/estimates/capture_alignment.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

constexpr const char* kWithoutConstant =
    "errors do not include a constant offset or rotation between camera and capture: the alignment removed it";

double as_ms(double us) { return us / 1000; }

std::vector<double> transform_numbers(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

/// Times are relative to the start of the recording, so that its device's clock does not matter.
double offset_from_start_us(const CaptureRequest& request, double offset_us) {
  return offset_us + static_cast<double>(request.answers.front().timestamp_us);
}

nlohmann::json alignment_json(const CaptureRequest& request, const CaptureAlignment& alignment) {
  const auto rounded_ms = [&](double us) { return reports::rounded(as_ms(offset_from_start_us(request, us))); };
  nlohmann::json transform = nlohmann::json::array();
  for (const double value : transform_numbers(alignment.T_camera_capture))
    transform.push_back(reports::rounded(value));
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
  const auto start_ms = [&](double us) { return as_ms(offset_from_start_us(request, us)); };
  const std::vector<double> T = transform_numbers(alignment.T_camera_capture);
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
