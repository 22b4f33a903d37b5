#pragma once

#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {

/// A framebuffer of the camera's size with numbers of triangles and depths. It goes with its
/// context.
class Framebuffer {
 public:
  /// `storage` is unorm16, unorm24, unorm32 or float32. Left bound.
  /// Fails    InputError where the driver does not offer it.
  Framebuffer(const GlFunctions& gl, const Camera& camera, Storage storage, int samples);

  void bind(GLenum target) const { gl_.BindFramebuffer(target, framebuffer_); }
  [[nodiscard]] int granted_samples() const { return granted_samples_; }

 private:
  /// The samples granted.
  int attach(GLenum format, GLenum place, const Camera& camera, int samples) const;

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  int granted_samples_ = 1;
};

/// What the depths and numbers of triangles of one framebuffer are resolved to in another, which is
/// then bound for reading.
void resolve(const GlFunctions& gl, const Framebuffer& from, const Framebuffer& to,
             const Camera& camera);

}  // namespace fathom::validation
