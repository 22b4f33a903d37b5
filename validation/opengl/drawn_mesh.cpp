#include "validation/opengl/drawn_mesh.h"

#include <vector>

#include "fathom/image/depth_map.h"
#include "validation/opengl/shader_program.h"

namespace fathom::validation {
namespace {

using attribution::RasterModel;
using attribution::WorldMesh;

constexpr const char* vertex_shader = R"(#version 330
layout(location = 0) in vec3 position;
uniform mat4 clip_from_held;
void main() { gl_Position = clip_from_held * vec4(position, 1.0); }
)";
constexpr const char* fragment_shader = R"(#version 330
layout(location = 0) out uint triangle;
void main() { triangle = uint(gl_PrimitiveID); }
)";

/// Positions and corners of the triangles, as what the next draw takes.
void hand_over(const GlFunctions& gl, const WorldMesh& mesh, const RasterModel& model) {
  std::vector<float> held;
  held.reserve(3 * mesh.points.size());
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      held.push_back(static_cast<float>((p[k] - model.shift[k]) * model.scale[k]));
    }
  }
  std::array<GLuint, 2> buffers{};
  GLuint array = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  gl.GenBuffers(2, buffers.data());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(held.size() * sizeof(float)), held.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(CornerIndices)),
                mesh.triangles.data(), GL_STATIC_DRAW);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(0);
}

}  // namespace

DrawnMesh::DrawnMesh(const GlFunctions& gl, const WorldMesh& mesh, const RasterModel& model)
    : gl_(gl), index_count_(static_cast<GLsizei>(3 * mesh.triangles.size())) {
  const GLuint program = use_new_program(gl, vertex_shader, fragment_shader);
  gl.UniformMatrix4fv(gl.GetUniformLocation(program, "clip_from_held"), 1, GL_TRUE,
                      model.matrix->data());
  hand_over(gl, mesh, model);
}

void DrawnMesh::draw(const Camera& camera, const OpenGlVariant& variant) const {
  gl_.Viewport(0, 0, static_cast<GLsizei>(camera.width), static_cast<GLsizei>(camera.height));
  if (variant.reversed) gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const GLfloat cleared = variant.reversed ? 0.0F : 1.0F;
  const GLuint nothing = no_surface;
  gl_.ClearBufferfv(GL_DEPTH, 0, &cleared);
  gl_.ClearBufferuiv(GL_COLOR, 0, &nothing);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(variant.reversed ? GL_GREATER : GL_LESS);
  if (variant.offset_units == 0) {
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
  } else {
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(0, static_cast<GLfloat>(variant.offset_units));
  }
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace fathom::validation
