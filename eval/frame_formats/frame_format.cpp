#include "eval/frame_formats/frame_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/registry.h"
#include "eval/program.h"
#include "eval/terminal.h"
#include "reports/estimates.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kFramesAndLicense = R"(
Cameras: x right, y down, z forward. Pixel centers have integer coordinates; row
0 is the top. Depth is z along the optical axis, not the ray's length; 0 means
no value. Images have no lens distortion.
The hand's frame: origin midway between wrist joint and middle MCP, fixed to the
palm; -z to the fingertips, +y out of the back of the hand, the thumb of a right
hand at -x. Angle 0 is a straight finger; flexion bends to the palm.

License: {}
The program that rendered the files is glovebench, MIT License, Copyright (c)
2026 The glovebench authors.
)";
constexpr std::string_view kMeshLicense =
    "the hand is generic-hand/right.glb of npm's\n@webxr-input-profiles/assets 1.0.20, MIT License, Copyright (c) "
    "2019 Amazon.";

Estimator stored_estimates(const std::string& path, uint64_t seed) {
  return [estimates = reports::read_estimates(path), seed](const DeviceFrame&, int number) {
    return reports::find_hand(estimates, seed, number);
  };
}

}  // namespace

const FrameFormat& find_frame_format(std::string_view name) {
  return find_in(frame_formats(), name, "--format", "frame format");
}

std::string dataset_readme(const FrameFormat& format, const RunSpec& spec) {
  const size_t count = frames_of(spec).size();
  std::string text =
      fmt::format("{} of {}, format {}\n", reports::counted(count, "frame"), spec.trajectory->name, format.name);
  text += fmt::format("subject {} ({}), {} noise x {}, seed {}\nglovebench {}, commit {}\n\n", spec.subject,
                      to_string(spec.appearance), spec.noise.model, spec.noise.factor, spec.seed,
                      program_info().version, program_info().commit);
  text += format.conventions;
  const bool shows_mesh = spec.subject < render::kFirstCapsuleSubject;
  text += fmt::format(kFramesAndLicense, shows_mesh ? kMeshLicense : "the hand is made by glovebench.");
  return text;
}

void write_frames(Workbench& workbench, const RunSpec& spec, const Estimator& estimate, const FrameFormat& format,
                  const Dataset& dataset) {
  render::SyntheticKinect kinect = make_kinect(workbench, spec);  // may throw: before the folder is made
  const std::unique_ptr<FrameWriter> writer = format.make(dataset);
  const std::span<const HandFrame> frames = frames_of(spec);
  Progress progress("rendering", workbench.config().quiet);
  for (size_t f = 0; f < frames.size(); ++f) {
    const DeviceFrame images = *kinect.next_frame();
    const int number = spec.frames.first + static_cast<int>(f);
    writer->add({number, images, frames[f], kinect, estimate ? estimate(images, number) : std::nullopt});
    progress.show(static_cast<double>(f + 1) / static_cast<double>(frames.size()));
  }
  writer->finish();
}

void write_run_mcaps(Workbench& workbench, std::span<const RunSpec> specs, const std::string& folder) {
  const FrameFormat& mcap = find_frame_format("mcap");
  std::vector<reports::ExperimentKey> written;
  for (const RunSpec& spec : specs) {
    const reports::ExperimentKey key = key_of(spec);
    if (std::ranges::find(written, key) != written.end()) continue;
    written.push_back(key);
    const Dataset dataset{folder, to_string(key), workbench.calibration(), workbench.model(),
                          dataset_readme(mcap, spec)};
    write_frames(workbench, spec, stored_estimates(folder + "/" + reports::estimates_file(key), spec.seed), mcap,
                 dataset);
  }
}

}  // namespace glovebench::eval
