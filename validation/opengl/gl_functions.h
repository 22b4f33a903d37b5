#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

namespace fathom::validation {

/// The functions of OpenGL 4.5 that are called here, looked up through EGL: no OpenGL library is
/// linked.
/// Fails    InputError, naming a function that the driver does not have.
struct GlFunctions {
  GlFunctions();

  // NOLINTBEGIN(readability-identifier-naming): OpenGL's own names, without gl
  decltype(&::glGetString) GetString;
  decltype(&::glGetIntegerv) GetIntegerv;
  decltype(&::glGetError) GetError;
  decltype(&::glViewport) Viewport;
  decltype(&::glEnable) Enable;
  decltype(&::glDisable) Disable;
  decltype(&::glDepthFunc) DepthFunc;
  decltype(&::glPolygonOffset) PolygonOffset;
  decltype(&::glDrawArrays) DrawArrays;
  decltype(&::glReadBuffer) ReadBuffer;
  decltype(&::glReadPixels) ReadPixels;
  decltype(&::glPixelStorei) PixelStorei;
  decltype(&::glBindTexture) BindTexture;
  PFNGLACTIVETEXTUREPROC ActiveTexture;
  decltype(&::glFinish) Finish;
  PFNGLCLEARBUFFERFVPROC ClearBufferfv;
  PFNGLCLEARBUFFERUIVPROC ClearBufferuiv;
  PFNGLCLIPCONTROLPROC ClipControl;
  PFNGLGENFRAMEBUFFERSPROC GenFramebuffers;
  PFNGLBINDFRAMEBUFFERPROC BindFramebuffer;
  PFNGLDELETEFRAMEBUFFERSPROC DeleteFramebuffers;
  PFNGLFRAMEBUFFERTEXTURE2DPROC FramebufferTexture2D;
  PFNGLGENRENDERBUFFERSPROC GenRenderbuffers;
  PFNGLBINDRENDERBUFFERPROC BindRenderbuffer;
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC RenderbufferStorageMultisample;
  PFNGLGETRENDERBUFFERPARAMETERIVPROC GetRenderbufferParameteriv;
  PFNGLGETFRAMEBUFFERATTACHMENTPARAMETERIVPROC GetFramebufferAttachmentParameteriv;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC FramebufferRenderbuffer;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC CheckFramebufferStatus;
  PFNGLBLITFRAMEBUFFERPROC BlitFramebuffer;
  PFNGLGETINTERNALFORMATIVPROC GetInternalformativ;
  PFNGLGETMULTISAMPLEFVPROC GetMultisamplefv;
  PFNGLGENBUFFERSPROC GenBuffers;
  PFNGLBINDBUFFERPROC BindBuffer;
  PFNGLBUFFERDATAPROC BufferData;
  PFNGLGENVERTEXARRAYSPROC GenVertexArrays;
  PFNGLBINDVERTEXARRAYPROC BindVertexArray;
  PFNGLVERTEXATTRIBPOINTERPROC VertexAttribPointer;
  PFNGLVERTEXATTRIBIPOINTERPROC VertexAttribIPointer;
  PFNGLENABLEVERTEXATTRIBARRAYPROC EnableVertexAttribArray;
  PFNGLCREATESHADERPROC CreateShader;
  PFNGLSHADERSOURCEPROC ShaderSource;
  PFNGLCOMPILESHADERPROC CompileShader;
  PFNGLCREATEPROGRAMPROC CreateProgram;
  PFNGLATTACHSHADERPROC AttachShader;
  PFNGLLINKPROGRAMPROC LinkProgram;
  PFNGLGETPROGRAMIVPROC GetProgramiv;
  PFNGLUSEPROGRAMPROC UseProgram;
  PFNGLUNIFORMMATRIX4FVPROC UniformMatrix4fv;
  PFNGLGETUNIFORMLOCATIONPROC GetUniformLocation;
  PFNGLGETUNIFORMFVPROC GetUniformfv;
  // NOLINTEND(readability-identifier-naming)
};

/// A program of two shaders, from their texts; it is in use from then on.
/// Fails    InputError where the driver does not take them.
GLuint use_new_program(const GlFunctions& gl, const char* vertex_shader,
                       const char* fragment_shader);

}  // namespace fathom::validation
