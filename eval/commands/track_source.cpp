#include "eval/commands/track_source.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "core/adapters/freenect/live_kinect.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/kinect/recording.h"
#include "core/kinect/rectified_device.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kRecording = "fakenect:", kLive = "freenect";

TrackSource open_recording(const SourceFlags& flags, bool quiet) {
  const std::string folder = flags.source.substr(kRecording.size());
  auto device = flags.calibration.empty()
                    ? std::make_unique<RecordingDevice>(folder)
                    : std::make_unique<RecordingDevice>(folder, load_calibration(flags.calibration));
  const RecordingDevice* recording = device.get();
  say_changed(flags.source, recording->changed(), quiet);
  return {std::move(device), recording->frame_count(),
          [recording] { return recording->unpaired_depth_count() + recording->repeated_count(); },
          system_us,  // a frame arrives when it is read
          [] { return std::string(); }};
}

[[noreturn]] void refuse(const std::string& source) {
  throw Error("--source", "kind", source, "fakenect:FOLDER, freenect or freenect:INDEX");
}

/// 0 for "freenect", N for "freenect:N".
int device_index(const std::string& source) {
  const std::string_view rest = std::string_view(source).substr(kLive.size());
  if (rest.empty()) return 0;
  int index = -1;
  const char* end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data() + 1, end, index);
  if (rest[0] != ':' || error != std::errc() || stop != end || index < 0) refuse(source);
  return index;
}

TrackSource open_live(const SourceFlags& flags) {
  const int index = device_index(flags.source);
  const RgbdCalibration calibration =
      flags.calibration.empty() ? nominal_kinect_calibration() : load_calibration(flags.calibration);
  LiveOptions options{.index = index, .every_frame = flags.every_frame, .interrupted = Interruption::wished};
  if (!flags.calibration.empty()) options.calibration_name = flags.calibration;
  // A played recording may pause as long as the original did.
  if (flags.every_frame) options.silence_limit = std::numeric_limits<double>::infinity();
  std::unique_ptr<LiveKinect> device = open_kinect(calibration, options);
  const LiveKinect* live = device.get();
  return {std::move(device), 0, [live] { return live->losses().total(); }, [live] { return live->arrived_us(); },
          [live] { return live->end(); }};
}

}  // namespace

void SourceFlags::add(Command command, const std::string& help) {
  command.option("--source", source, help).required();
  command.option("--calibration", calibration,
                 "calibration (*.json) [the recording's; of a Kinect: nominal values]");
}

void take_spread(TrackSource& source, int count, const std::string& title, bool quiet,
                 const std::function<void(const DeviceFrame&)>& take) {
  const int64_t all = source.frame_count > 0 ? source.frame_count : count;
  const int64_t wanted = std::min<int64_t>(count, all);
  Progress progress(title, quiet);
  int taken = 0;
  for (int64_t number = 0; taken < count; ++number) {
    std::optional<DeviceFrame> frame;
    try {
      frame = source.device->next_frame();
    } catch (const FrameError& e) {
      if (!quiet) say("glovebench: skipped: {}\n", e.what());
      continue;
    }
    if (!frame) break;
    if (number > 0 && number * wanted / all == (number - 1) * wanted / all) continue;
    take(*frame);
    progress.show(static_cast<double>(++taken) / static_cast<double>(wanted));
  }
}

std::vector<TrackResult> track_recording(TrackSource& source, Method& method, bool quiet) {
  std::vector<TrackResult> results;
  take_spread(source, std::max(source.frame_count, 1), "tracking", quiet,
              [&](const DeviceFrame& frame) { results.push_back(method.track(frame, results)); });
  return results;
}

void say_changed(const std::string& source, const std::vector<std::string>& files, bool quiet) {
  if (!quiet && !files.empty())
    say("glovebench: {}: {} changed since it was recorded\n", source, fmt::join(files, ", "));
}

TrackSource open_source(const SourceFlags& flags, bool quiet) {
  const bool is_recording = flags.source.starts_with(kRecording);
  if (!is_recording && !flags.source.starts_with(kLive)) refuse(flags.source);
  TrackSource source = is_recording ? open_recording(flags, quiet) : open_live(flags);
  try {
    source.device = without_lens_distortion(std::move(source.device));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", flags.calibration.empty() ? flags.source : flags.calibration, e.what()));
  }
  return source;
}

}  // namespace glovebench::eval
