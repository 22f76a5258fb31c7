#include "core/kinect/recording.h"
#include "eval/sources/source.h"

namespace glovebench::eval {
namespace {

TrackSource open_fakenect(const std::string& folder, const SourceFlags& flags, bool quiet) {
  auto device = flags.calibration.empty()
                    ? std::make_unique<RecordingDevice>(folder)
                    : std::make_unique<RecordingDevice>(folder, load_calibration(flags.calibration));
  const RecordingDevice* recording = device.get();
  say_changed(flags.source, recording->changed(), quiet);
  return recorded_source(std::move(device), recording->frame_count(),
                         [recording] { return recording->unpaired_depth_count() + recording->repeated_count(); });
}

}  // namespace

SourceKind fakenect_source() { return {"fakenect", "fakenect:FOLDER", "a Kinect's recording", open_fakenect}; }

}  // namespace glovebench::eval
