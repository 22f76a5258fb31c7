#include <fmt/format.h>

#include "core/adapters/freenect/live_kinect.h"
#include "core/base/error.h"

namespace glovebench {

const bool kHasFreenect = false;

std::unique_ptr<LiveKinect> open_kinect(const RgbdCalibration&, const LiveOptions& options) {
  throw Error("freenect", fmt::format("device {}", options.index),
              "a glovebench that was built without libfreenect",
              "one that was configured with it (Debian: libfreenect-dev)");
}

}  // namespace glovebench
