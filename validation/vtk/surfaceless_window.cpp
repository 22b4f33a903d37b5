#include "validation/vtk/surfaceless_window.h"

#include <fcntl.h>
#include <unistd.h>
#include <vtkAutoInit.h>
#include <vtkObjectFactory.h>

#include <cstdio>

#include "validation/opengl/gl_functions.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
namespace fathom::validation {
namespace {

/// Discards what this process writes to standard error while it lives. For libraries that write
/// there and cannot be told not to.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_ = -1;
};

QuietStderr::QuietStderr() : kept_(::dup(STDERR_FILENO)) {
  std::fflush(stderr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  if (kept_ < 0) return;
  std::fflush(stderr);
  ::dup2(kept_, STDERR_FILENO);
  ::close(kept_);
}

}  // namespace

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
