#include "eval/measured_run.h"

#include "eval/in_parallel.h"

namespace glovebench::eval {

std::vector<reports::FrameErrors> measure(const Run& run, const HandModel& tracker_hand,
                                          const render::Subject& subject) {
  std::vector<reports::FrameErrors> errors;
  const std::span<const HandFrame> frames = frames_of(run.spec);
  for (size_t f = 0; f < frames.size(); ++f) {
    const reports::FrameTruth truth = {
        frames[f].posture,          frames[f].T_camera_hand, subject.joints(frames[f].posture),
        run.seen[f].visible_pixels, run.seen[f].trackable,   run.seen[f].visible_percent};
    const int number = run.spec.frames.first + static_cast<int>(f);
    errors.push_back(reports::measure_frame(number, run.answers[f], truth, tracker_hand));
  }
  return errors;
}

std::vector<MeasuredRun> measure(Workbench& workbench, std::vector<Run> runs) {
  std::vector<MeasuredRun> measured(runs.size());
  in_parallel(workbench.config().threads, runs.size(), [&](size_t r) {
    const render::Subject subject = workbench.subject(runs[r].spec.subject);
    std::vector<reports::FrameErrors> errors = measure(runs[r], *workbench.model(), subject);
    measured[r] = {std::move(runs[r]), std::move(errors)};
  });
  return measured;
}

}  // namespace glovebench::eval
