#pragma once

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/vtk/explain_depth.h"
#include "validation/opengl/egl_context.h"
#include "validation/vtk/surfaceless_window.h"
#include "validation/vtk/vtk_renderer.h"

namespace fathom::vtk {

/// Coordinates as VTK may keep them.
enum class Coordinates { binary32, binary64 };

/// A sphere of radius 1 about the origin, of triangles whose corners are nowhere round.
vtkSmartPointer<vtkPolyData> ball(int rings = 12, Coordinates kept = Coordinates::binary64);

/// A VTK window without a display, with one renderer; its camera looks along −z from (0.1, 0.2, 5).
class Drawing {
 public:
  Drawing();
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  /// An actor of these triangles, by a mapper of VTK's own or by the one given.
  vtkActor& add(vtkPolyData* triangles, vtkSmartPointer<vtkPolyDataMapper> mapper = nullptr);

  [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }
  [[nodiscard]] vtkCamera& camera() { return *renderer_->GetActiveCamera(); }
  [[nodiscard]] validation::SurfacelessWindow& window() { return *window_; }
  DepthVerdict explained() { return explain_depth(*window_, *renderer_); }

 private:
  validation::EglContext context_;  // outlives the window
  vtkNew<validation::SurfacelessWindow> window_;
  vtkNew<vtkRenderer> renderer_;
};

/// Pixels where the exact map shows a surface.
std::size_t covered_pixels(const DepthVerdict& verdict);

}  // namespace fathom::vtk
