#pragma once

#include <memory>

namespace glovebench::render {

/// An off-screen OpenGL 4.5 core context (OSMesa). Several threads draw in turn, bit for bit alike: while a context
/// is current in one thread, others wait to make theirs current. One context may serve several threads one after
/// the other; a thread has at most one that is current. Mesa's own threads are switched off for the whole process
/// (LP_NUM_THREADS=0): images are small, and callers work on several frames at once instead. The first context must
/// not be made while another thread reads or writes the environment.
class Context {
 public:
  /// Throws Error saying what was asked for if it is refused. The new context is current.
  Context();
  /// It must be current in the calling thread.
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes this the context that the calling thread draws with; waits for the thread that is drawing now.
  void make_current() const;
  /// Leaves the calling thread without a context, so that no thread remembers one that another destroys.
  void release() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Makes a context current for as long as this lives.
class CurrentContext {
 public:
  explicit CurrentContext(const Context& context) : context_(context) { context_.make_current(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  const Context& context_;
};

}  // namespace glovebench::render
