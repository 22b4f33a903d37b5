#include "validation/opengl/gl_functions.h"

#include <EGL/egl.h>

#include <algorithm>
#include <string>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

template <class Function>
void find(Function& function, const char* name) {
  function = reinterpret_cast<Function>(eglGetProcAddress(name));
  if (function == nullptr) {
    throw InputError(std::string("OpenGL: the driver has no ") + name +
                     ": OpenGL 3.3 with glClipControl is needed");
  }
}

}  // namespace

GlFunctions::GlFunctions() {
  find(GetString, "glGetString");
  find(GetIntegerv, "glGetIntegerv");
  find(GetError, "glGetError");
  find(Viewport, "glViewport");
  find(Enable, "glEnable");
  find(Disable, "glDisable");
  find(DepthFunc, "glDepthFunc");
  find(PolygonOffset, "glPolygonOffset");
  find(DrawArrays, "glDrawArrays");
  find(ReadBuffer, "glReadBuffer");
  find(ReadPixels, "glReadPixels");
  find(PixelStorei, "glPixelStorei");
  find(BindTexture, "glBindTexture");
  find(ActiveTexture, "glActiveTexture");
  find(Finish, "glFinish");
  find(ClearBufferfv, "glClearBufferfv");
  find(ClearBufferuiv, "glClearBufferuiv");
  find(ClipControl, "glClipControl");
  find(GenFramebuffers, "glGenFramebuffers");
  find(BindFramebuffer, "glBindFramebuffer");
  find(DeleteFramebuffers, "glDeleteFramebuffers");
  find(FramebufferTexture2D, "glFramebufferTexture2D");
  find(GenRenderbuffers, "glGenRenderbuffers");
  find(BindRenderbuffer, "glBindRenderbuffer");
  find(RenderbufferStorageMultisample, "glRenderbufferStorageMultisample");
  find(GetRenderbufferParameteriv, "glGetRenderbufferParameteriv");
  find(GetFramebufferAttachmentParameteriv, "glGetFramebufferAttachmentParameteriv");
  find(FramebufferRenderbuffer, "glFramebufferRenderbuffer");
  find(CheckFramebufferStatus, "glCheckFramebufferStatus");
  find(BlitFramebuffer, "glBlitFramebuffer");
  find(GetInternalformativ, "glGetInternalformativ");
  find(GetMultisamplefv, "glGetMultisamplefv");
  find(GenBuffers, "glGenBuffers");
  find(BindBuffer, "glBindBuffer");
  find(BufferData, "glBufferData");
  find(GenVertexArrays, "glGenVertexArrays");
  find(BindVertexArray, "glBindVertexArray");
  find(VertexAttribPointer, "glVertexAttribPointer");
  find(VertexAttribIPointer, "glVertexAttribIPointer");
  find(EnableVertexAttribArray, "glEnableVertexAttribArray");
  find(CreateShader, "glCreateShader");
  find(ShaderSource, "glShaderSource");
  find(CompileShader, "glCompileShader");
  find(CreateProgram, "glCreateProgram");
  find(AttachShader, "glAttachShader");
  find(LinkProgram, "glLinkProgram");
  find(GetProgramiv, "glGetProgramiv");
  find(UseProgram, "glUseProgram");
  find(UniformMatrix4fv, "glUniformMatrix4fv");
  find(GetUniformLocation, "glGetUniformLocation");
  find(GetUniformfv, "glGetUniformfv");
}

GLuint use_new_program(const GlFunctions& gl, const char* vertex_shader,
                       const char* fragment_shader) {
  const GLuint program = gl.CreateProgram();
  const auto add = [&](GLenum kind, const char* text) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
  };
  add(GL_VERTEX_SHADER, vertex_shader);
  add(GL_FRAGMENT_SHADER, fragment_shader);
  gl.LinkProgram(program);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) throw InputError("OpenGL: the driver does not take the shaders");
  gl.UseProgram(program);
  return program;
}

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

/// An image read from the bottom, its rows turned.
template <class T>
std::vector<T> read_pixels(const GlFunctions& gl, std::uint32_t width, std::uint32_t height,
                           GLenum format, GLenum type) {
  std::vector<T> read(std::size_t{width} * height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), format, type,
                read.data());
  std::vector<T> turned(read.size());
  for (std::size_t row = 0; row < height; ++row) {
    std::copy_n(&read[(height - 1 - row) * width], width, &turned[row * width]);
  }
  return turned;
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

Storage depth_attachment_storage(const GlFunctions& gl, GLenum target) {
  GLint bits = 0, type = 0;
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &bits);
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
  return storage_of_attachment(bits, type == GL_FLOAT);
}

std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage) {
  constexpr GLenum depths = GL_DEPTH_COMPONENT;
  if (storage == Storage::float32) {
    const auto read = read_pixels<float>(gl, width, height, depths, GL_FLOAT);
    return {read.begin(), read.end()};
  }
  const auto windows = [&](const auto& pixels) {
    std::vector<double> made(pixels.size());
    std::transform(pixels.begin(), pixels.end(), made.begin(),
                   [&](std::uint32_t pixel) { return window_depth_of_pixel(storage, pixel); });
    return made;
  };
  if (storage == Storage::unorm16) {
    return windows(read_pixels<std::uint16_t>(gl, width, height, depths, GL_UNSIGNED_SHORT));
  }
  return windows(read_pixels<std::uint32_t>(gl, width, height, depths, GL_UNSIGNED_INT));
}

std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height) {
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  return read_pixels<std::uint32_t>(gl, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT);
}

}  // namespace fathom::validation
