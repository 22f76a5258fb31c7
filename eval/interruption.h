#pragma once

#include <csignal>

namespace glovebench::eval {

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal was closed) are a wish that can be asked for.
/// The second SIGINT or SIGTERM ends the program; SIGHUP never does, and where it was ignored (nohup) it still is.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool wished();

 private:
  struct sigaction before_int_, before_term_, before_hup_;
};

}  // namespace glovebench::eval
