#pragma once

#include <CLI/CLI.hpp>

namespace glovebench::eval {

// Each adds one subcommand of `calibrate`.
void add_calibrate_cameras(CLI::App& calibrate);
void add_calibrate_colors(CLI::App& calibrate);
void add_calibrate_noise(CLI::App& calibrate);

}  // namespace glovebench::eval
