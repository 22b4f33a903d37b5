#include "fathom/vtk/camera_of.h"

#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLCamera.h>
#include <vtkRenderer.h>

#include <array>

#include "fathom/camera/camera_import.h"
#include "fathom/failures/errors.h"

namespace fathom::vtk {
namespace {

/// VTK keeps those for OpenGL column by column.
std::array<double, 16> rows_of(vtkMatrix4x4& columns) {
  std::array<double, 16> rows{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) rows.at(4 * r + c) = columns.GetElement(c, r);
  }
  return rows;
}

}  // namespace

Camera camera_of(vtkRenderer& renderer) {
  auto* const theirs = vtkOpenGLCamera::SafeDownCast(renderer.GetActiveCamera());
  if (theirs == nullptr) throw InputError("the renderer's camera is not a vtkOpenGLCamera");
  vtkMatrix4x4 *view = nullptr, *projection = nullptr, *both = nullptr;
  vtkMatrix3x3* normals = nullptr;
  theirs->GetKeyMatrices(&renderer, view, normals, projection, both);
  int width = 0, height = 0, left = 0, bottom = 0;
  renderer.GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  return camera_from_opengl(rows_of(*projection), rows_of(*view), static_cast<std::uint32_t>(width),
                            static_cast<std::uint32_t>(height));
}

}  // namespace fathom::vtk
