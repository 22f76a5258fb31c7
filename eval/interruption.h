#pragma once

#include <csignal>

namespace glovebench::eval {

/// While it lives, SIGINT, SIGTERM and SIGHUP only set a flag. A second SIGINT or SIGTERM ends the program. nohup
/// keeps working.
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
