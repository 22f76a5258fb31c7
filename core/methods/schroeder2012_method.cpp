#include "core/methods/method.h"

namespace glovebench {
namespace {

class Schroeder2012 : public Method {
 public:
  explicit Schroeder2012(const MethodInputs& in)
      : tracker_(in.config, in.calibration, in.model, in.database, in.table) {}
  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                    const StageObserver& observe) override {
    return tracker_.track(frame, previous, observe);
  }

 private:
  Tracker tracker_;
};

std::unique_ptr<Method> make_schroeder2012(const MethodInputs& inputs) {
  return std::make_unique<Schroeder2012>(inputs);
}

}  // namespace

MethodEntry schroeder2012_method() {
  return {"schroeder2012", "the paper's: look-up by color and depth, color-sensitive ICP on the point cloud",
          make_schroeder2012};
}

}  // namespace glovebench
