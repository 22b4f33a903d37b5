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

}  // namespace fathom::validation
