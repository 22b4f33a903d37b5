#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"

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
