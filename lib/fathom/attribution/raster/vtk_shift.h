#pragma once

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/world_mesh.h"

namespace fathom::attribution {

/// The model with `shift` set: where it is as VTK's, the middle of the box of all points if this is
/// more than 1000 of the box's diagonals from the origin, or the square of the diagonal is above
/// 1000 or below 1/1000, and else 0. As VTK does it with a mesh that one mapper draws where it is.
/// Source   vtkOpenGLVertexBufferObject::UpdateShiftScale, AUTO_SHIFT_SCALE.
RasterModel with_known_shift(const RasterModel& model, const WorldMesh& mesh);

}  // namespace fathom::attribution
