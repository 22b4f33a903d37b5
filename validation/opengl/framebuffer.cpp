#include "validation/opengl/framebuffer.h"

#include <algorithm>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

GLenum internal_format(Storage storage) {
  switch (storage) {
    case Storage::unorm16:
      return GL_DEPTH_COMPONENT16;
    case Storage::unorm24:
      return GL_DEPTH_COMPONENT24;
    case Storage::unorm32:
      return GL_DEPTH_COMPONENT32;
    case Storage::float32:
      return GL_DEPTH_COMPONENT32F;
    default:
      throw UsageError("OpenGL has no depth attachment of this type");
  }
}

}  // namespace

Framebuffer::Framebuffer(const GlFunctions& gl, const Camera& camera, Storage storage, int samples)
    : gl_(gl) {
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  attach(GL_R32UI, GL_COLOR_ATTACHMENT0, camera, samples);
  granted_samples_ = attach(internal_format(storage), GL_DEPTH_ATTACHMENT, camera, samples);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw InputError("OpenGL: the driver offers no framebuffer with this depth attachment" +
                     (samples > 1 ? " and " + std::to_string(samples) + " samples" : ""));
  }
}

int Framebuffer::attach(GLenum format, GLenum place, const Camera& camera, int samples) const {
  GLuint buffer = 0;
  gl_.GenRenderbuffers(1, &buffer);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format,
                                     static_cast<GLsizei>(camera.width),
                                     static_cast<GLsizei>(camera.height));
  GLint granted = 0;
  gl_.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &granted);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
  return std::max(granted, 1);
}

void resolve(const GlFunctions& gl, const Framebuffer& from, const Framebuffer& to,
             const Camera& camera) {
  from.bind(GL_READ_FRAMEBUFFER);
  to.bind(GL_DRAW_FRAMEBUFFER);
  const auto w = static_cast<GLint>(camera.width), h = static_cast<GLint>(camera.height);
  gl.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT, GL_NEAREST);
  to.bind(GL_READ_FRAMEBUFFER);
}

}  // namespace fathom::validation
