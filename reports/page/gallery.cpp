#include "reports/page/gallery.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr int kPerExperiment = 2;
constexpr int64_t kApartUs = 500'000;

bool is_preferred(const ExperimentKey& key, const NoiseSetting& noise) {
  return key.truth == TruthKind::source && key.subject == 1 && key.noise == noise;
}

/// All frames with this error, largest first, then earliest.
std::vector<WorstFrame> ranked(const std::vector<const ExperimentResult*>& experiments, std::string_view metric) {
  std::vector<WorstFrame> frames;
  for (const ExperimentResult* experiment : experiments)
    for (const SeedRun& run : experiment->runs)
      for (const FrameRecord& frame : run.frames)
        if (frame[metric]) frames.push_back({experiment->key, run.seed, frame, std::string(metric)});
  std::ranges::stable_sort(
      frames, [&](const WorstFrame& a, const WorstFrame& b) { return *a.frame[metric] > *b.frame[metric]; });
  return frames;
}

bool may_join(const std::vector<WorstFrame>& chosen, const WorstFrame& candidate) {
  int of_experiment = 0;
  for (const WorstFrame& other : chosen) {
    if (other.key != candidate.key) continue;
    ++of_experiment;
    if (std::abs(other.frame.timestamp_us - candidate.frame.timestamp_us) < kApartUs) return false;
  }
  return of_experiment < kPerExperiment;
}

/// Quoted for the shell: names from a user's file may contain anything.
std::string shell_quoted(const std::string& text) {
  const bool is_plain = std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-.+/").find(c) != std::string::npos;
  });
  if (is_plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::vector<WorstFrame> worst_frames(const RunResult& result, int count) {
  const NoiseSetting noise = headline_noise(result);
  std::vector<const ExperimentResult*> experiments;
  for (const ExperimentResult& experiment : result.experiments)
    if (is_preferred(experiment.key, noise)) experiments.push_back(&experiment);
  if (experiments.empty())
    for (const ExperimentResult& experiment : result.experiments) experiments.push_back(&experiment);

  std::vector<WorstFrame> chosen;
  const auto add = [&](std::string_view metric, int most) {
    for (const WorstFrame& candidate : ranked(experiments, metric))
      if (static_cast<int>(chosen.size()) < most && may_join(chosen, candidate)) chosen.push_back(candidate);
  };
  add("position_error_mm", count / 2);
  add("posture_rms_deg", static_cast<int>(chosen.size()) + count - count / 2);
  return chosen;
}

std::string explain_command(const WorstFrame& worst, const std::string& folder) {
  return fmt::format("glovebench explain {} {} --experiment {} --seed {}", shell_quoted(folder), worst.frame.frame,
                     shell_quoted(to_string(worst.key)), worst.seed);
}

std::string caption(const WorstFrame& worst) {
  return fmt::format("{} with {}, {} truth, frame {}, noise seed {}: {} mm, posture {} deg, rotation {} deg",
                     worst.key.trajectory, worst.key.database, to_string(worst.key.truth), worst.frame.frame,
                     worst.seed, fixed(worst.frame["position_error_mm"], 1),
                     fixed(worst.frame["posture_rms_deg"], 1), fixed(worst.frame["rotation_error_deg"], 1));
}

}  // namespace glovebench::reports
