#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

namespace fathom::validation {

/// A VTK window that draws into framebuffer objects of the current context, which has no display
/// (EglContext).
///
/// VTK prepares OpenGL through GLEW, and Debian's GLEW looks for an X display: it loads everything
/// that is needed and then fails, so VTK would try again, and pass the meshes to OpenGL again, in
/// every frame. Here this is done once, and quietly.
///
/// VTK's own windows make a context that tests depths with GL_LEQUAL. A
/// vtkGenericOpenGLRenderWindow takes OpenGL's state from its context, as it finds it in each
/// frame, and a new context tests with GL_LESS: this one is set as VTK's own.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static SurfacelessWindow* New();
  vtkTypeMacro(SurfacelessWindow, vtkGenericOpenGLRenderWindow)

  void OpenGLInitContext() override;

 protected:
  SurfacelessWindow();

 private:
  bool prepared_ = false;
};

}  // namespace fathom::validation
