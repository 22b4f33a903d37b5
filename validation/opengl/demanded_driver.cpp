#include "validation/opengl/demanded_driver.h"

#include <cstdlib>

#include "fathom/failures/errors.h"

namespace fathom::validation {

// A driver that Mesa takes from another variable, or that is not Mesa's, has its own line here.
void demand(Driver driver) {
  if (driver == Driver::usual) return;
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  ::setenv("GALLIUM_DRIVER", name_of(driver).c_str(), 1);
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // that it is missing is said in our words
}

void require(Driver driver, const std::string& gl_renderer) {
  // "softpipe", "llvmpipe (LLVM 15.0.6, 256 bits)"
  if (driver == Driver::usual || gl_renderer.starts_with(name_of(driver))) return;
  throw InputError(name_of(driver) + ": OpenGL has no such driver here" +
                   (gl_renderer.empty() ? "" : " and draws with " + gl_renderer) +
                   "; a Mesa that is built with it provides it (Debian's libgl1-mesa-dri is)");
}

}  // namespace fathom::validation
