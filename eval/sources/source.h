#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/kinect/device.h"
#include "core/methods/method.h"
#include "eval/commands/options.h"

namespace glovebench::eval {

struct TrackSource {
  std::unique_ptr<Device> device;
  int frame_count = 0;                    ///< 0: live
  std::function<int()> dropped;           ///< lost images and frames
  std::function<int64_t()> arrived_us;    ///< when the last frame was complete, since 1970
  std::function<std::string()> ended_by;  ///< why a live device ended
};
/// A frame arrives when it is read.
TrackSource recorded_source(std::unique_ptr<Device> device, int frame_count, std::function<int()> dropped);

struct SourceFlags {
  std::string source;       ///< as `SourceKind::usage`
  std::string calibration;  ///< file; empty: the recording's, else a nominal Kinect's
  std::string topics;       ///< "color=TOPIC,depth=TOPIC"; empty: a RealSense camera's
  bool every_frame = false;

  /// `help`: what the frames show; the kinds follow.
  void add(Command command, const std::string& help);
};

/// eval/sources/X_source.cpp defines `SourceKind X_source()`.
struct SourceKind {
  std::string_view name;   ///< of `--source NAME:ARGUMENT`
  std::string_view usage;  ///< for the help; brackets: may be left out
  std::string_view description;
  /// Warns of a changed recording unless `quiet`.
  /// Throws: Error.
  TrackSource (*open)(const std::string& argument, const SourceFlags& flags, bool quiet);
  bool is_live = false;     ///< a camera: needs no argument, takes --every-frame
  bool has_topics = false;  ///< takes --topics
};
std::span<const SourceKind> source_kinds();

/// Rectifies the images.
/// Throws: Error, also for an unknown kind.
TrackSource open_source(const SourceFlags& flags, bool quiet);

/// Gives `take` up to `count` frames, spread over a recording or a live device's first. Skips damaged frames, and
/// names them on stderr unless `quiet`. `title`: for the progress bar.
void take_spread(TrackSource& source, int count, const std::string& title, bool quiet,
                 const std::function<void(const DeviceFrame&)>& take);

/// Treats damaged frames as `take_spread`.
/// Throws: Error.
std::vector<TrackResult> track_recording(TrackSource& source, Method& method, bool quiet);

/// Names changed files on stderr unless `quiet`.
void say_changed(const std::string& source, const std::vector<std::string>& files, bool quiet);

}  // namespace glovebench::eval
