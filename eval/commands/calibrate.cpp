#include "eval/commands/calibrate.h"

#include "eval/commands/command.h"

namespace glovebench::eval {

void add_calibrate(CLI::App& program) {
  CLI::App* calibrate =
      program.add_subcommand("calibrate", "Measure a device's cameras, or what results can be told apart by.");
  calibrate->require_subcommand(1);
  add_calibrate_cameras(*calibrate);
  add_calibrate_noise(*calibrate);
}

}  // namespace glovebench::eval
