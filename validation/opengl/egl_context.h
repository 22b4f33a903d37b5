#pragma once

#include <memory>
#include <string>

#include "validation/variants/variants.h"

namespace fathom::validation {

class VirtualDisplay;

/// An OpenGL context without a window or a screen, for drawing into framebuffer objects. It needs
/// no display if the driver supports EGL_MESA_platform_surfaceless, and otherwise starts its own
/// Xvfb. It is current on the thread that made it until it is destroyed.
///
/// Environment  Mesa's software renderer reads LP_NUM_THREADS when the context is made.
///              FATHOM_OPENGL_DISPLAY=xvfb forces an Xvfb. Another driver than the usual one
///              sets variables: demand().
/// Needs        a process that has started no threads, for Xvfb and for another driver; and for
///              that also one in which no other context was made.
/// Fails        InputError: one line with the step that failed and the package to install.
class EglContext {
 public:
  explicit EglContext(Driver driver = Driver::usual);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// GL_RENDERER and GL_VERSION, "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 …" for instance, and
  /// way().
  [[nodiscard]] std::string description() const;
  /// ", on Xvfb" or "".
  [[nodiscard]] std::string way() const;
  void make_current() const;

 private:
  void open_somehow();
  void open(unsigned platform);
  void close();

  std::unique_ptr<VirtualDisplay> virtual_display_;  // outlives the rest
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;
};

/// Makes OpenGL load `driver` on this machine instead of its default. Changes nothing for the usual
/// driver.
///
/// Environment  of this process, from then on: what Mesa reads when a display is opened.
/// Needs        a process that has not opened a display through EGL, and has no other threads.
void demand(Driver driver);

/// Fails    InputError, in one line, unless GL_RENDERER is that of the driver.
void require(Driver driver, const std::string& gl_renderer);

}  // namespace fathom::validation
