#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/kinect/device.h"

namespace glovebench::eval {

struct TrackSource {
  std::unique_ptr<Device> device;
  int frame_count = 0;                    ///< 0: live, without a known end
  std::function<int()> dropped;           ///< images or frames lost so far
  std::function<int64_t()> arrived_us;    ///< when the last frame was whole, us since 1970
  std::function<std::string()> ended_by;  ///< why a live device ended
};

struct SourceFlags {
  std::string source;       ///< "fakenect:FOLDER" or "freenect[:INDEX]"
  std::string calibration;  ///< file; empty: the recording's, or that of a nominal Kinect
  bool every_frame = false;
};

/// Says if a recording was changed by hand, unless it is to be quiet. Throws Error: an unknown kind, no such
/// device, no such recording, a build without libfreenect.
TrackSource open_source(const SourceFlags& flags, bool quiet);

/// Says on stderr which files of a recording were changed since it was recorded; nothing if none was, or if it is
/// to be quiet.
void say_changed(const std::string& source, const std::vector<std::string>& files, bool quiet);

}  // namespace glovebench::eval
