#include <limits>

#include "core/adapters/freenect/live_kinect.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kUsage = "freenect[:INDEX]";

int device_index(const std::string& argument) {
  const std::optional<int> index = argument.empty() ? 0 : number_in<int>(argument);
  if (index.value_or(-1) < 0) throw Error("--source", "index", argument, std::string(kUsage));
  return *index;
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
