#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/methods/method.h"

namespace glovebench {

struct ProcessLimits {
  std::chrono::milliseconds first_frame{20'000};  ///< to answer after a start
  std::chrono::milliseconds frame{5'000};         ///< to answer later
  int restarts = 3;
};

/// The tracker is a program, `inputs.config.method` = "exec:COMMAND" (eval/guides/tracker.md). A frame without a
/// good answer is `missing`, with a reason, and the next one starts the program again. After the last restart,
/// frames are lost at once. Other fields of the configuration have no effect.
/// Throws: Error for an empty command; later, from `track`, if the shell cannot start it.
std::unique_ptr<Method> make_process_method(const MethodInputs& inputs, const ProcessLimits& limits = {});

/// Hash of the command and its files: words that are regular files, and its program in PATH.
/// Throws: Error if one is unreadable.
std::string program_hash(const std::string& method);

}  // namespace glovebench
