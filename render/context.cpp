#include "render/context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdlib>
#include <mutex>

#include "core/base/error.h"

namespace glovebench::render {
namespace {

/// Held by the thread that draws. Whenever a context draws or is read, llvmpipe (Mesa 22.3) looks through what all
/// contexts of the process are about to draw, and nothing keeps their threads from changing it meanwhile: without
/// this, a process with several drawing threads crashes once in a few hours (lp_scene_is_resource_referenced).
std::mutex& driver() {
  static std::mutex mutex;
  return mutex;
}

/// True if this thread holds it.
thread_local bool draws = false;

/// The one place where Mesa is configured. It reads the variables when the first context is made. What a user's
/// desktop needs must not reach it: another driver would draw other pixels, and one that is not there, or another
/// version of GLSL, crashes OSMesa.
void configure_mesa() {
  static std::once_flag once;
  std::call_once(once, [] {
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    unsetenv("MESA_GLSL_VERSION_OVERRIDE");
  });
}

}  // namespace

/// OSMesa wants a window-like buffer; everything is drawn into framebuffer objects instead.
struct Context::State {
  OSMesaContext context = nullptr;
  std::array<uint8_t, 4 * 4 * 4> buffer{};
};

Context::Context() : state_(std::make_unique<State>()) {
  configure_mesa();
  const std::array<int, 15> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_STENCIL_BITS,
                                          0,
                                          OSMESA_ACCUM_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          4,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          5,
                                          0};
  {
    const std::lock_guard lock(driver());
    state_->context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  }
  if (!state_->context)
    throw Error("renderer", "OpenGL context", "refused by OSMesa", "an off-screen OpenGL 4.5 core context");
  try {
    make_current();
  } catch (...) {
    const std::lock_guard lock(driver());
    OSMesaDestroyContext(state_->context);
    throw;
  }
}

Context::~Context() {
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  OSMesaDestroyContext(state_->context);
  draws = false;
  driver().unlock();
}

void Context::make_current() const {
  check(!draws, "a thread draws with one context at a time");
  std::unique_lock lock(driver());
  check(OSMesaMakeCurrent(state_->context, state_->buffer.data(), 0x1401 /* GL_UNSIGNED_BYTE */, 4, 4),
        "an OSMesa context can be made current");
  lock.release();  // `release` or the destructor unlocks
  draws = true;
}

void Context::release() {
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  draws = false;
  driver().unlock();
}

}  // namespace glovebench::render
