#include "validation/vtk/recording_mapper.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkShaderProgram.h>

#include "validation/opengl/gl_functions.h"

namespace fathom::validation {

vtkStandardNewMacro(RecordingMapper);

void RecordingMapper::SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                                vtkActor* actor) {
  Superclass::SetCameraShaderParameters(drawn, renderer, actor);
  const GlFunctions gl;
  const auto program = static_cast<GLuint>(drawn.Program->GetHandle());
  const GLint place = gl.GetUniformLocation(program, "MCDCMatrix");
  if (place < 0) return;
  std::array<float, 16> columns{};
  gl.GetUniformfv(program, place, columns.data());
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      clip_from_held_[4 * row + column] = columns[4 * column + row];
    }
  }
  vtkOpenGLVertexBufferObject* const held = VBOs->GetVBO("vertexMC");
  if (held == nullptr || !held->GetCoordShiftAndScaleEnabled()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    shift_[k] = held->GetShift().at(k);
    scale_[k] = held->GetScale().at(k);
  }
}

}  // namespace fathom::validation
