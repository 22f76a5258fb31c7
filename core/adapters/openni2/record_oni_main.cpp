// For tests. record_oni FILE [WORD...]: records the images of test_camera.h through OpenNI2's recorder.
#include <OpenNI.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "core/adapters/openni2/test_camera.h"

namespace {

namespace camera = glovebench::test_camera;

bool fine(openni::Status status) {
  if (status != openni::STATUS_OK) std::fprintf(stderr, "record_oni: %s\n", openni::OpenNI::getExtendedError());
  return status == openni::STATUS_OK;
}

/// In the order of their times.
void show_images(openni::VideoStream& depth, openni::VideoStream& color) {
  for (int d = 0, c = 0; d < camera::kFrames || c < camera::kFrames;) {
    const bool is_color =
        d == camera::kFrames || (c < camera::kFrames && c * camera::kColorPeriod_us < d * camera::kDepthPeriod_us);
    int number = is_color ? c++ : d++;
    if (is_color && !color.isValid()) continue;
    (is_color ? color : depth).invoke(camera::kShow, number);
  }
}

/// The recorder starts in a thread of its own, and loses the images that come before.
bool record(const std::string& name, const char* file, std::chrono::milliseconds start) {
  openni::Device device;
  if (!fine(device.open(name.c_str()))) return false;
  const bool has_color = device.hasSensor(openni::SENSOR_COLOR);
  openni::VideoStream depth, color;
  openni::Recorder recorder;
  if (!fine(depth.create(device, openni::SENSOR_DEPTH)) || !fine(recorder.create(file))) return false;
  if (has_color && (!fine(color.create(device, openni::SENSOR_COLOR)) || !fine(recorder.attach(color))))
    return false;
  if (!fine(recorder.attach(depth)) || !fine(recorder.start()) || !fine(depth.start())) return false;
  if (has_color && !fine(color.start())) return false;
  std::this_thread::sleep_for(start);
  show_images(depth, color);
  recorder.stop();
  recorder.destroy();
  return true;
}

int recorded_frames(const char* file) {
  openni::Device device;
  openni::VideoStream depth;
  if (!fine(device.open(file)) || !fine(depth.create(device, openni::SENSOR_DEPTH))) return 0;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // as openni2_player.cpp
  return device.getPlaybackControl()->getNumberOfFrames(depth);
}

}  // namespace

int main(int count, char** arguments) {
  std::string name(camera::kName);
  for (int i = 2; i < count; ++i) name += std::string(" ") + arguments[i];
  if (count < 2 || !fine(openni::OpenNI::initialize())) return 2;
  for (std::chrono::milliseconds start(50); start.count() < 10'000; start *= 2)
    if (!record(name, arguments[1], start))
      return 1;
    else if (recorded_frames(arguments[1]) >= camera::kFrames)
      return 0;
  return 1;
}
