// Shows that the tracker needs no truth. This program links only the core, which cannot read trajectories. It
// loads a recording, forbids itself to open more files, and tracks.
//
//     tracker_isolation MESH DATABASE COLOR_TABLE RECORDING
//
// Prints one line per estimate (`estimate_line`).

#include <fcntl.h>
#include <sys/resource.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/kinect/recording.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker.h"

namespace {

using namespace glovebench;

/// From here on no file can be opened; this cannot be undone.
void forbid_files(const char* some_file) {
  const rlimit none{0, 0};
  if (setrlimit(RLIMIT_NOFILE, &none) != 0) throw std::runtime_error("files cannot be forbidden");
  if (open(some_file, O_RDONLY | O_CLOEXEC) >= 0) throw std::runtime_error("files can still be opened");
}

void track_recording(char** arguments) {
  const auto model = std::make_shared<const HandModel>(HandModel::load(arguments[1]));
  const auto database = std::make_shared<const Database>(Database::load(arguments[2]));
  const auto table = std::make_shared<const ColorTable>(ColorTable::load(arguments[3]));
  RecordingDevice device(arguments[4]);
  std::vector<DeviceFrame> frames;
  while (std::optional<DeviceFrame> frame = device.next_frame()) frames.push_back(std::move(*frame));
  forbid_files(arguments[1]);

  const Tracker tracker(profile("paper"), device.calibration(), model, database, table);
  std::vector<TrackResult> results;
  for (size_t f = 0; f < frames.size(); ++f) {
    results.push_back(tracker.track(frames[f], results));
    std::printf("%s\n", estimate_line(static_cast<int>(f), results.back()).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 5) throw std::runtime_error("usage: tracker_isolation MESH DATABASE COLOR_TABLE RECORDING");
    track_recording(argv);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tracker_isolation: %s\n", e.what());
    return 2;
  }
}
