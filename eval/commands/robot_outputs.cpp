#include "eval/commands/robot_outputs.h"

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench::eval {

void BusFlags::add(Command command, const std::string& what) {
  command.option("--robot", middleware, what);
  command.option("--robot-interface", interface,
                 "network interface for --robot [loopback alone, or what CYCLONEDDS_URI says]");
  command.option("--security", security, "folder of keys for DDS Security (`glovebench robot-server keys`) [none]");
}

int BusFlags::domain() const {
  constexpr std::string_view kDds = "dds";
  const std::string_view rest = std::string_view(middleware).substr(std::min(kDds.size(), middleware.size()));
  std::optional<int> domain;
  if (middleware == kDds) domain = 0;
  if (middleware.starts_with(kDds) && rest.starts_with(':')) domain = number_in<int>(rest.substr(1));
  if (domain.value_or(-1) < 0) throw Error("--robot", "middleware", middleware, "dds or dds:DOMAIN");
  return *domain;
}

RobotOutputs::RobotOutputs(const std::string& file, const std::optional<RobotBusOptions>& bus) {
  if (bus) bus_ = join_robot_bus(*bus);
  if (!file.empty()) file_ = std::make_unique<JsonLinesSink>(file);
}

void RobotOutputs::send(CommandGuard& guard, const RobotCommand& command, int64_t arrived_us) {
  const int64_t now_us = bus_ ? bus_->start(guard, command) : command.timestamp_us;
  const std::optional<RobotCommand> safe = guard.guard(command, now_us);
  if (!safe) return;
  if (bus_) bus_->send(*safe, arrived_us);  // first, since a disk may be slow
  if (file_) file_->send(*safe);
}

void RobotOutputs::finish(bool whole) {
  if (bus_) bus_->finish();
  if (file_ && whole) file_->finish();
}

}  // namespace glovebench::eval
