#pragma once

#include <csignal>

namespace glovebench::eval {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM is a wish that can be asked for; the second of
/// either ends the program.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool wished();

 private:
  struct sigaction before_int_, before_term_;
};

}  // namespace glovebench::eval
