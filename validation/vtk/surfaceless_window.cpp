#include "validation/vtk/surfaceless_window.h"

#include <vtkAutoInit.h>
#include <vtkObjectFactory.h>

#include "validation/opengl/gl_functions.h"
#include "validation/vtk/quiet_stderr.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace fathom::validation {

vtkStandardNewMacro(SurfacelessWindow);

SurfacelessWindow::SurfacelessWindow() {
  SetOwnContext(0);
  SetIsDirect(1);
  SetSupportsOpenGL(1);
  SetIsCurrent(true);
  SetReadyForRendering(true);
  SetMultiSamples(0);
  SetFrameBlitModeToNoBlit();
  GlFunctions().DepthFunc(GL_LEQUAL);
}

void SurfacelessWindow::OpenGLInitContext() {
  if (prepared_) return;
  const QuietStderr quiet;
  Superclass::OpenGLInitContext();
  Initialized = true;
  GlewInitValid = true;
  prepared_ = true;
}

}  // namespace fathom::validation
