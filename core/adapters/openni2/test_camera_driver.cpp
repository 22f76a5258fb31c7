// For tests: a driver of OpenNI2 for a camera that shows known images on command. Those of OpenNI2's own
// DummyDevice cannot be played once they are recorded.
#include <Driver/OniDriverAPI.h>

#include <cstring>
#include <string>

#include "core/adapters/openni2/test_camera.h"

#define XN_NEW(type, argument) new type(argument)
#define XN_DELETE(pointer) delete pointer

namespace glovebench::test_camera {
namespace {

template <typename Value>
OniStatus give(const Value& value, void* data, const int* size) {
  if (*size != sizeof value) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

class Stream : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType sensor, const OniVideoMode& mode, bool mirrored)
      : sensor_(sensor), mode_(mode), mirrored_(mirrored) {}

  OniStatus start() override { return ONI_STATUS_OK; }
  void stop() override {}
  OniStatus getProperty(int property, void* data, int* size) override {
    switch (property) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(stride(), data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{}, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(OniBool{mirrored_}, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(int{10'000}, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(kHorizontalFov, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(kVerticalFov, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }
  OniStatus invoke(int command, void* data, int size) override {
    if (command != kShow || size != sizeof(int)) return ONI_STATUS_BAD_PARAMETER;
    int number = 0;
    std::memcpy(&number, data, sizeof number);
    show(number);
    return ONI_STATUS_OK;
  }

 private:
  bool is_depth() const { return sensor_ == ONI_SENSOR_DEPTH; }
  int stride() const {
    const int bytes = mode_.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2;
    return bytes * mode_.resolutionX;
  }
  void show(int number) {
    OniFrame* frame = getServices().acquireFrame();
    frame->dataSize = stride() * mode_.resolutionY;
    frame->sensorType = sensor_;
    frame->timestamp = 1'000'000 + number * (is_depth() ? kDepthPeriod_us : kColorPeriod_us);
    frame->frameIndex = number;
    frame->width = mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->videoMode = mode_;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->stride = stride();
    if (mode_.pixelFormat == ONI_PIXEL_FORMAT_YUV422)
      std::memset(frame->data, 0, frame->dataSize);
    else
      draw(number, static_cast<uint8_t*>(frame->data));
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }
  void draw(int number, uint8_t* to) const {
    for (int v = 0; v < mode_.resolutionY; ++v) {
      for (int x = 0; x < mode_.resolutionX; ++x) {
        const int u = mirrored_ ? mode_.resolutionX - 1 - x : x;
        const uint16_t step = depth_step(u, v, number);
        const Rgb rgb = color(u, v, number);
        if (is_depth())
          std::memcpy(to, &step, sizeof step);
        else
          std::memcpy(to, &rgb, sizeof rgb);
        to += is_depth() ? sizeof step : sizeof rgb;
      }
    }
  }

  OniSensorType sensor_;
  OniVideoMode mode_;
  bool mirrored_;
};

class Device : public oni::driver::DeviceBase {
 public:
  explicit Device(const std::string& name)
      : is_mirrored_(has(name, kMirrored)), count_(has(name, kDepthOnly) ? 1 : 2) {
    modes_[0] = {has(name, kFine) ? ONI_PIXEL_FORMAT_DEPTH_100_UM : ONI_PIXEL_FORMAT_DEPTH_1_MM, kDepthWidth,
                 kDepthHeight, 30};
    modes_[1] = {has(name, kYuv) ? ONI_PIXEL_FORMAT_YUV422 : ONI_PIXEL_FORMAT_RGB888, kColorWidth, kColorHeight,
                 25};
    sensors_[0] = {ONI_SENSOR_DEPTH, 1, &modes_[0]};
    sensors_[1] = {ONI_SENSOR_COLOR, 1, &modes_[1]};
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = count_;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType sensor) override {
    return new Stream(sensor, modes_[sensor == ONI_SENSOR_DEPTH ? 0 : 1], is_mirrored_);
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

 private:
  static bool has(const std::string& name, std::string_view word) { return name.find(word) != std::string::npos; }

  bool is_mirrored_;
  int count_;
  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
};

class Driver : public oni::driver::DriverBase {
 public:
  using DriverBase::DriverBase;

  OniStatus tryDevice(const char* name) override {
    if (!std::string_view(name).starts_with(kName)) return ONI_STATUS_ERROR;
    OniDeviceInfo info = {};
    std::strncpy(info.uri, name, sizeof info.uri - 1);
    deviceConnected(&info);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char* name, const char*) override { return new Device(name); }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}
};

}  // namespace
}  // namespace glovebench::test_camera

ONI_EXPORT_DRIVER(glovebench::test_camera::Driver)
