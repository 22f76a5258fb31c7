#include "eval/interruption.h"

namespace glovebench::eval {
namespace {

volatile std::sig_atomic_t wish = 0;

void note_wish(int) {
  wish = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// Stays installed, since the kernel and the shell may both report a closed terminal.
void note_hang_up(int) {
  wish = 1;
}

}  // namespace

Interruption::Interruption() {
  wish = 0;
  struct sigaction once = {};
  once.sa_handler = note_wish;
  once.sa_flags = SA_RESTART;
  sigaction(SIGINT, &once, &before_int_);
  sigaction(SIGTERM, &once, &before_term_);
  sigaction(SIGHUP, nullptr, &before_hup_);
  if (before_hup_.sa_handler == SIG_IGN) return;  // nohup: goes on without a terminal
  struct sigaction always = once;
  always.sa_handler = note_hang_up;
  sigaction(SIGHUP, &always, nullptr);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
  sigaction(SIGHUP, &before_hup_, nullptr);
}

bool Interruption::wished() {
  return wish != 0;
}

}  // namespace glovebench::eval
