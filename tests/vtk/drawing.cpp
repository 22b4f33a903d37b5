#include "tests/vtk/drawing.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/image/depth_map.h"

namespace fathom::vtk {

vtkSmartPointer<vtkPolyData> ball(int rings, Coordinates kept) {
  vtkNew<vtkPoints> points;
  if (kept == Coordinates::binary64) points->SetDataTypeToDouble();
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double turn = 2 * std::numbers::pi * (j + 0.1) / around;
      points->InsertNextPoint(std::sin(polar) * std::cos(turn), std::cos(polar),
                              std::sin(polar) * std::sin(turn));
    }
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < rings; ++i) {
    for (vtkIdType j = 0; j < around; ++j) {
      const vtkIdType a = i * around + j, b = i * around + (j + 1) % around;
      cells->InsertNextCell({a, b, a + around});
      cells->InsertNextCell({b, b + around, a + around});
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

Drawing::Drawing() {
  window_->SetSize(160, 120);
  window_->SetMultiSamples(0);
  window_->AddRenderer(renderer_);
  camera().SetPosition(0.1, 0.2, 5);
  camera().SetFocalPoint(0.1, 0.2, 0);
  camera().SetClippingRange(1, 20);
}

Drawing::~Drawing() {
  window_->Finalize();
}

vtkActor& Drawing::add(vtkPolyData* triangles, vtkSmartPointer<vtkPolyDataMapper> mapper) {
  if (mapper == nullptr) mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(triangles);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer_->AddActor(actor);
  return *actor;
}

std::size_t covered_pixels(const DepthVerdict& verdict) {
  const auto& shown = verdict.truth.triangles;
  return shown.size() -
         static_cast<std::size_t>(std::count(shown.begin(), shown.end(), no_surface));
}

}  // namespace fathom::vtk
