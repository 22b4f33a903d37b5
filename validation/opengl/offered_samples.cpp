#include "validation/opengl/offered_samples.h"

#include <algorithm>
#include <iterator>

#include "validation/opengl/egl_context.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {

std::vector<int> offered_samples(Driver driver) {
  const EglContext context(driver);
  const GlFunctions gl;
  const auto offered = [&](GLenum format) {
    GLint count = 0;
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_NUM_SAMPLE_COUNTS, 1, &count);
    std::vector<GLint> counts(static_cast<std::size_t>(count));
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, count, counts.data());
    std::sort(counts.begin(), counts.end());
    return counts;
  };
  const std::vector<GLint> depths = offered(GL_DEPTH_COMPONENT24), numbers = offered(GL_R32UI);
  std::vector<int> both;
  std::set_intersection(depths.begin(), depths.end(), numbers.begin(), numbers.end(),
                        std::back_inserter(both));
  both.erase(both.begin(), std::upper_bound(both.begin(), both.end(), 1));
  return both;
}

}  // namespace fathom::validation
