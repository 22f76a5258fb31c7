#include "eval/commands/robot_outputs.h"

#include <charconv>

#include "core/base/error.h"
#ifdef GLOVEBENCH_DDS
#include "core/robot/dds/dds_sink.h"
#endif

namespace glovebench::eval {

int dds_domain(const std::string& middleware, const std::string& option) {
  constexpr std::string_view kDds = "dds";
  const std::string_view rest = std::string_view(middleware).substr(std::min(kDds.size(), middleware.size()));
  int domain = 0;
  bool known = middleware.starts_with(kDds);
  if (known && !rest.empty()) {
    const auto [stop, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), domain);
    known = rest[0] == ':' && error == std::errc() && stop == rest.data() + rest.size() && domain >= 0;
  }
  if (!known) throw Error(option, "middleware", middleware, "dds or dds:DOMAIN");
#ifndef GLOVEBENCH_DDS
  throw Error(option, middleware, "a glovebench that was built without Cyclone DDS",
              "one that was configured with it (Debian: cyclonedds-dev, cyclonedds-tools)");
#endif
  return domain;
}

#ifdef GLOVEBENCH_DDS
class RobotOutputs::Stream : public DdsSink {
  using DdsSink::DdsSink;
};
#else
class RobotOutputs::Stream {
 public:
  explicit Stream(int) {}
  void frame_arrived(int64_t) {}
  void send(const RobotCommand&) {}
  void finish() {}
};
#endif

RobotOutputs::RobotOutputs(const std::string& file, const std::string& middleware) {
  if (!file.empty()) file_ = std::make_unique<JsonLinesSink>(file);
  if (!middleware.empty()) stream_ = std::make_unique<Stream>(dds_domain(middleware, "--robot"));
}

RobotOutputs::~RobotOutputs() = default;

void RobotOutputs::send(const RobotCommand& command, int64_t arrived_us) {
  if (stream_) {  // first: a slow disk does not hold the robot up
    stream_->frame_arrived(arrived_us);
    stream_->send(command);
  }
  if (file_) file_->send(command);
}

void RobotOutputs::finish(bool whole) {
  if (stream_) stream_->finish();
  if (file_ && whole) file_->finish();
}

}  // namespace glovebench::eval
