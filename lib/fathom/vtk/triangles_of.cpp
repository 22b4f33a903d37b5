#include "fathom/vtk/triangles_of.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace fathom::vtk {
namespace {

/// Calls `take` with the list of corners of each cell.
template <class Take>
void each_cell(vtkCellArray* cells, const Take& take) {
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    cells->GetCellAtId(i, corners);
    take(*corners);
  }
}

CornerIndices triangle(vtkIdList& corners, vtkIdType a, vtkIdType b, vtkIdType c) {
  const auto id = [&](vtkIdType k) { return static_cast<std::uint32_t>(corners.GetId(k)); };
  return {id(a), id(b), id(c)};
}

}  // namespace

Mesh triangles_of(vtkPolyData& data) {
  Mesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    double p[3];
    data.GetPoint(i, p);
    mesh.vertices.push_back({p[0], p[1], p[2]});
  }
  each_cell(data.GetPolys(), [&](vtkIdList& corners) {
    for (vtkIdType k = 2; k < corners.GetNumberOfIds(); ++k) {
      mesh.triangles.push_back(triangle(corners, 0, k - 1, k));
    }
  });
  each_cell(data.GetStrips(), [&](vtkIdList& corners) {
    for (vtkIdType k = 2; k < corners.GetNumberOfIds(); ++k) {
      const bool turned = k % 2 != 0;  // every second triangle of a strip runs the other way
      mesh.triangles.push_back(
          triangle(corners, turned ? k - 1 : k - 2, turned ? k - 2 : k - 1, k));
    }
  });
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

}  // namespace fathom::vtk
