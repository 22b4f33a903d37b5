#pragma once

#include "fathom/mesh/mesh.h"

class vtkPolyData;

namespace fathom::vtk {

/// Polygons, as fans from their first corners, and triangle strips, in the order in which VTK draws
/// them; points are exact.
/// Needs    at most 2³² − 1 points.
Mesh triangles_of(vtkPolyData& data);

}  // namespace fathom::vtk
