#pragma once

#include <memory>

namespace glovebench::render {

/// An off-screen OpenGL 4.5 core context (OSMesa). Only one thread draws at a time; making a context current waits
/// for it. A thread has at most one current context. The first context sets LP_NUM_THREADS=0: create it while no
/// thread uses the environment.
class Context {
 public:
  /// Makes it current.
  /// Throws: Error if OpenGL refuses.
  Context();
  /// Must be current in this thread.
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current() const;
  static void release();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

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
