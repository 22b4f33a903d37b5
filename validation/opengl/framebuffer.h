#pragma once

#include <cstdint>
#include <vector>

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

// What a framebuffer holds, exactly. Rows run from the top.

/// The type that the driver gave the depth attachment of the framebuffer bound to `target`.
/// Fails    InputError if depth buffers are not known to have that type.
Storage depth_attachment_storage(const GlFunctions& gl, GLenum target);

/// Window depths of the framebuffer bound for reading: read as integers of the storage's own width,
/// which OpenGL's conversion leaves exact, or as binary32.
std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage);

/// The first colour attachment, whose texels are integers.
std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height);

}  // namespace fathom::validation
