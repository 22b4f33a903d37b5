#include "validation/vtk/translucent_pane.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <array>

#include "fathom/attribution/model/renderer_camera.h"

namespace fathom::validation {
namespace {

using attribution::CameraRays;

std::array<double, 3> shown_at(const CameraRays& rays, double u, double v, double depth) {
  const auto value = [&](const CameraRays::Affine& f, std::size_t k) {
    return f.at_corner[k] + u * f.per_u[k] + v * f.per_v[k];
  };
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = value(rays.origin, k) + depth * value(rays.direction, k);
  }
  return point;
}

}  // namespace

vtkSmartPointer<vtkActor> translucent_pane(const Camera& camera) {
  const CameraRays rays = attribution::camera_rays(camera);
  const double depth = camera.near + (camera.far - camera.near) / 1000;
  const double right = camera.width + 1.0, lower = camera.height + 1.0;  // one pixel more all round
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& [u, v] :
       {std::array{-1.0, -1.0}, {right, -1.0}, {right, lower}, {-1.0, lower}}) {
    points->InsertNextPoint(shown_at(rays, u, v, depth).data());
  }
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(points);
  polygons->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polygons);
  auto pane = vtkSmartPointer<vtkActor>::New();
  pane->SetMapper(mapper);
  pane->GetProperty()->LightingOff();
  pane->GetProperty()->SetOpacity(0.5);
  return pane;
}

}  // namespace fathom::validation
