#pragma once

#include <memory>

namespace glovebench::render {

/// An off-screen OpenGL 4.5 core context (OSMesa). It belongs to the thread that made it: one context a thread, and
/// all of them draw bit for bit alike. Mesa's own threads are switched off for the whole process
/// (LP_NUM_THREADS=0): images are small, and callers work on several frames at once instead. The first context must
/// not be made while another thread reads or writes the environment.
class Context {
 public:
  /// Throws Error saying what was asked for if it is refused.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes this the context that the calling thread draws with.
  void make_current() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glovebench::render
