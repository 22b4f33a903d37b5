#pragma once

#include <string>

namespace fathom::validation {

/// An OpenGL context without a window, a display or a surface (EGL_MESA_platform_surfaceless): what
/// is drawn goes to framebuffer objects. Current on the thread that made it until it is destroyed.
///
/// Environment  Mesa's software renderer reads LP_NUM_THREADS when the context is made.
/// Fails        InputError: one line that says which step failed and what to install.
class EglContext {
 public:
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// GL_RENDERER and GL_VERSION, "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 …" for instance.
  [[nodiscard]] std::string description() const;
  [[nodiscard]] bool is_current() const;
  void make_current() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace fathom::validation
