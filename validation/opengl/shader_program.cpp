#include "validation/opengl/shader_program.h"

#include "fathom/failures/errors.h"

namespace fathom::validation {

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
