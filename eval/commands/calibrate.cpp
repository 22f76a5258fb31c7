#include "eval/commands/calibrate.h"

#include "eval/commands/command.h"

namespace glovebench::eval {

void add_calibrate(CLI::App& program) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Measure what the tracker or the gate must know.");
  calibrate->require_subcommand(1);
  add_calibrate_cameras(*calibrate);
  add_calibrate_colors(*calibrate);
  add_calibrate_noise(*calibrate);
}

}  // namespace glovebench::eval
