#include <charconv>
#include <limits>

#include "core/adapters/freenect/live_kinect.h"
#include "core/base/error.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kUsage = "freenect[:INDEX]";

int device_index(const std::string& argument) {
  int index = 0;
  const char* end = argument.data() + argument.size();
  const auto [stop, error] = std::from_chars(argument.data(), end, index);
  if (!argument.empty() && (error != std::errc() || stop != end || index < 0))
    throw Error("--source", "index", argument, std::string(kUsage));
  return index;
}

TrackSource open_freenect(const std::string& argument, const SourceFlags& flags, bool) {
  const RgbdCalibration calibration =
      flags.calibration.empty() ? nominal_kinect_calibration() : load_calibration(flags.calibration);
  LiveOptions options{
      .index = device_index(argument), .every_frame = flags.every_frame, .interrupted = Interruption::wished};
  if (!flags.calibration.empty()) options.calibration_name = flags.calibration;
  // A played recording may pause as long as the original did.
  if (flags.every_frame) options.silence_limit = std::numeric_limits<double>::infinity();
  std::unique_ptr<LiveKinect> device = open_kinect(calibration, options);
  const LiveKinect* live = device.get();
  return {std::move(device), 0, [live] { return live->losses().total(); }, [live] { return live->arrived_us(); },
          [live] { return live->end(); }};
}

}  // namespace

SourceKind freenect_source() {
  return {
      .name = "freenect", .usage = kUsage, .description = "a Kinect v1", .open = open_freenect, .is_live = true};
}

}  // namespace glovebench::eval
