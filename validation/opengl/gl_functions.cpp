#include "validation/opengl/gl_functions.h"

#include <EGL/egl.h>

#include <string>

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

}  // namespace fathom::validation
