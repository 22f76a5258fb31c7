#include "eval/sources/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/kinect/rectified_device.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

[[noreturn]] void refuse(const std::string& source) {
  std::vector<std::string_view> usages;
  for (const SourceKind& kind : source_kinds()) usages.push_back(kind.usage);
  throw Error("--source", "kind", source, fmt::format("one of {}", fmt::join(usages, ", ")));
}

TrackSource open_distorted(const SourceFlags& flags, bool quiet) {
  const size_t colon = flags.source.find(':');
  const auto found = std::ranges::find(source_kinds(), flags.source.substr(0, colon), &SourceKind::name);
  if (found == source_kinds().end()) refuse(flags.source);
  const std::string argument = colon == std::string::npos ? "" : flags.source.substr(colon + 1);
  if (argument.empty() && !(found->is_live && colon == std::string::npos)) refuse(flags.source);
  if (flags.every_frame && !found->is_live) throw Error("--every-frame", "--source", flags.source, "freenect");
  if (!flags.topics.empty() && !found->has_topics)
    throw Error("--topics", "--source", flags.source, "bag:FILE or mcap:FILE");
  return found->open(argument, flags, quiet);
}

}  // namespace

TrackSource recorded_source(std::unique_ptr<Device> device, int frame_count, std::function<int()> dropped) {
  return {std::move(device), frame_count, std::move(dropped), system_us, [] { return std::string(); }};
}

void SourceFlags::add(Command command, const std::string& help) {
  std::vector<std::string> kinds;
  for (const SourceKind& kind : source_kinds())
    kinds.push_back(fmt::format("{}, {}", kind.usage, kind.description));
  command.option("--source", source, fmt::format("{}: {}", help, fmt::join(kinds, "; "))).required();
  command.option("--calibration", calibration,
                 "calibration (*.json) [the recording's; of a Kinect: nominal values]");
  command.option("--topics", topics,
                 "bag, mcap: color=TOPIC,depth=TOPIC, each with camera_info beside it [of RealSense cameras]");
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
  TrackSource source = open_distorted(flags, quiet);
  try {
    source.device = without_lens_distortion(std::move(source.device));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", flags.calibration.empty() ? flags.source : flags.calibration, e.what()));
  }
  return source;
}

}  // namespace glovebench::eval
