#include "validation/opengl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "fathom/numeric/errors.h"

namespace fathom::validation {
namespace {

[[noreturn]] void fail(const std::string& step) {
  throw InputError("OpenGL without a display: " + step +
                   " failed; the packages libegl1 and libgl1-mesa-dri provide it");
}

void* surfaceless_display() {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) fail("finding eglGetPlatformDisplayEXT");
  void* const display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplayEXT");
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) fail("eglInitialize");
  return display;
}

/// A compatible context where there is one, as VTK's own windows make it.
void* make_context(void* display) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("eglBindAPI");
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE,
                                     EGL_PBUFFER_BIT,  // not the default, a window
                                     EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count < 1) {
    fail("eglChooseConfig");
  }
  void* const context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
  if (context == EGL_NO_CONTEXT) fail("eglCreateContext");
  return context;
}

}  // namespace

EglContext::EglContext() : display_(surfaceless_display()) {
  context_ = make_context(display_);
  make_current();
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string EglContext::description() const {
  // GL_RENDERER and GL_VERSION; libGL itself is not linked.
  using GetString = const unsigned char* (*)(unsigned int);
  const auto get_string = reinterpret_cast<GetString>(eglGetProcAddress("glGetString"));
  const auto text = [&](unsigned int name) -> std::string {
    const unsigned char* value = get_string != nullptr ? get_string(name) : nullptr;
    return value != nullptr ? reinterpret_cast<const char*>(value) : "unknown";
  };
  return text(0x1F01) + ", " + text(0x1F02);
}

bool EglContext::is_current() const {
  return eglGetCurrentContext() == context_;
}

void EglContext::make_current() const {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    fail("eglMakeCurrent");
  }
}

}  // namespace fathom::validation
