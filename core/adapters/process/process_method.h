#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/methods/method.h"

namespace glovebench {

struct ProcessLimits {
  std::chrono::milliseconds first_frame{20'000};  ///< to answer the first frame after a start
  std::chrono::milliseconds frame{5'000};         ///< to answer another frame
  int restarts = 3;                               ///< of a program that failed
};

/// The tracker is the program of `inputs.config.method`, "exec:COMMAND". It starts with the first frame and gets
/// calibration, hand and frames (eval/guides/tracker.md). A frame without a good answer is lost (`missing`, with a
/// reason), and the next one starts the program again. Frames after the last restart are lost at once. The
/// configuration's other fields have no effect.
/// Throws: Error for an empty command; later, from `track`, if the shell cannot start it.
std::unique_ptr<Method> make_process_method(const MethodInputs& inputs, const ProcessLimits& limits = {});

/// Hash of the command and of the files that it names: words that are regular files, and its program in PATH.
/// Throws: Error if one is unreadable.
std::string program_hash(const std::string& method);

}  // namespace glovebench
