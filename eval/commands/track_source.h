#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/kinect/device.h"
#include "core/methods/method.h"
#include "eval/commands/options.h"

namespace glovebench::eval {

struct TrackSource {
  std::unique_ptr<Device> device;
  int frame_count = 0;                    ///< 0: live
  std::function<int()> dropped;           ///< number of lost images and frames
  std::function<int64_t()> arrived_us;    ///< when the last frame was complete, since 1970
  std::function<std::string()> ended_by;  ///< why a live device ended
};

struct SourceFlags {
  std::string source;       ///< "fakenect:FOLDER" or "freenect[:INDEX]"
  std::string calibration;  ///< file; empty: the recording's, else a nominal Kinect's
  bool every_frame = false;

  void add(Command command, const std::string& help);
};

/// Warns of a changed recording unless `quiet`.
/// Throws: Error for an unknown kind, a missing device or recording, or without libfreenect.
TrackSource open_source(const SourceFlags& flags, bool quiet);

/// Gives `take` up to `count` frames, spread over a recording or the first of a live device. Skips damaged frames,
/// and names them on stderr unless `quiet`. `title`: for the progress bar.
void take_spread(TrackSource& source, int count, const std::string& title, bool quiet,
                 const std::function<void(const DeviceFrame&)>& take);

/// The results of all frames of a recording. Skips damaged frames, and names them on stderr unless `quiet`.
/// Throws: Error.
std::vector<TrackResult> track_recording(TrackSource& source, Method& method, bool quiet);

/// Names changed files on stderr unless `quiet`.
void say_changed(const std::string& source, const std::vector<std::string>& files, bool quiet);

}  // namespace glovebench::eval
