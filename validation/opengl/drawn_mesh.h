#pragma once

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "validation/opengl/gl_functions.h"
#include "validation/variants/variants.h"

namespace fathom::validation {

/// A mesh that OpenGL holds: positions in binary32 as the model says, each vertex multiplied by the
/// model's matrix, the number of the triangle as its colour. It goes with its context.
class DrawnMesh {
 public:
  /// Needs    a model with a matrix.
  /// Fails    InputError where the driver does not take the shaders.
  DrawnMesh(const GlFunctions& gl, const attribution::WorldMesh& mesh,
            const attribution::RasterModel& model);

  /// Clears the framebuffer that is bound and draws the mesh into it.
  void draw(const Camera& camera, const OpenGlVariant& variant) const;

 private:
  const GlFunctions& gl_;
  GLsizei vertex_count_ = 0;
};

}  // namespace fathom::validation
