#include "eval/interruption.h"

namespace glovebench::eval {
namespace {

volatile std::sig_atomic_t wish = 0;

void note_wish(int) {
  wish = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  wish = 0;
  struct sigaction once = {};
  once.sa_handler = note_wish;
  once.sa_flags = SA_RESTART;
  sigaction(SIGINT, &once, &before_int_);
  sigaction(SIGTERM, &once, &before_term_);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
}

bool Interruption::wished() {
  return wish != 0;
}

}  // namespace glovebench::eval
