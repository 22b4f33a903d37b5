#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

namespace fathom::validation {

/// A VTK window that draws into framebuffer objects of the current context, which has no display
/// (EglContext).
///
/// VTK prepares OpenGL through GLEW, and Debian's GLEW looks for an X display: it loads everything
/// that is needed and then fails, so VTK would try again, and pass the meshes to OpenGL again, in
/// every frame. Here this is done once, and quietly.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static SurfacelessWindow* New();
  // clang-format off
  vtkTypeMacro(SurfacelessWindow, vtkGenericOpenGLRenderWindow)
      // clang-format on

      void OpenGLInitContext() override;

 protected:
  SurfacelessWindow();

 private:
  bool prepared_ = false;
};

}  // namespace fathom::validation
