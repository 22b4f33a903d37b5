#pragma once

#include <vtkOpenGLPolyDataMapper.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/depth_format/depth_format.h"
#include "validation/opengl/gl_functions.h"

class vtkPolyData;
class vtkPolyDataMapper;
class vtkShaderProperty;

/// Numbers of triangles as colours, drawn by VTK in the pass that writes the depth. A colour of 8
/// bits per channel holds the number plus 1, red lowest; the background is black. A fragment shader
/// replacement writes the colour, flat and after all light, so nothing interpolates, lights or
/// blends it, and the depth is computed as without it.
namespace fathom::validation {

/// Whether there are colours for all triangles of the mesh.
bool have_colours(const attribution::WorldMesh& mesh);

/// The mesh as VTK draws it, with three points of its own for each triangle, which hold its colour.
/// VTK sees the same points, in the same order within a triangle, so it holds the same positions.
/// Needs    have_colours().
void set_numbered_polygons(const attribution::WorldMesh& mesh, vtkPolyData& polygons);

/// Has VTK draw the colours that set_numbered_polygons() gave.
void draw_numbers(vtkPolyDataMapper& mapper, vtkShaderProperty& shader);

/// The numbers in the first colour attachment of the framebuffer that is bound for drawing, which
/// has one sample per pixel; width × height, rows from the top; no_surface where the background is.
/// Bindings are left as they are.
std::vector<std::uint32_t> read_triangle_numbers(const GlFunctions& gl, std::uint32_t width,
                                                 std::uint32_t height);

/// The same of the first sample of each pixel. Resolving would mix the colours of a pixel's
/// samples. Changes OpenGL's state beneath VTK: for a window that draws nothing more.
/// Fails    InputError where the attachment is no texture of several samples.
std::vector<std::uint32_t> read_triangle_numbers_of_first_sample(const GlFunctions& gl,
                                                                 std::uint32_t width,
                                                                 std::uint32_t height);

/// VTK's mapper for polygons, which also records what its last frame was drawn with and can draw
/// with reversed depths.
class RecordingMapper : public vtkOpenGLPolyDataMapper {
 public:
  static RecordingMapper* New();
  vtkTypeMacro(RecordingMapper, vtkOpenGLPolyDataMapper)

  /// The matrix from held positions to clip coordinates, row by row, as OpenGL had it.
  [[nodiscard]] const std::array<float, 16>& clip_from_held() const { return clip_from_held_; }
  /// From now on the greater window depth is the nearer one. If `zero_to_one`, the near and far
  /// planes lie at z = w and z = 0 in clip coordinates.
  void reverse(bool zero_to_one) {
    greater_is_nearer_ = true;
    zero_to_one_ = zero_to_one;
  }
  /// From now on the numbers of triangles are read as soon as the mesh is drawn, before
  /// anything else is drawn over it. Needs one sample per pixel.
  void record_numbers(std::uint32_t width, std::uint32_t height) {
    width_ = width;
    height_ = height;
  }
  /// Which of equal depths won in the last frame, by OpenGL's depth test; nothing for a test that
  /// is no order.
  [[nodiscard]] std::optional<EqualDepths> equal_depths() const { return equal_depths_; }
  /// Those of the last frame, rows from the top; empty if they are not recorded.
  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  /// Positions are held as (position − shift)·scale; world frame, scene units.
  [[nodiscard]] const std::array<double, 3>& shift() const { return shift_; }
  [[nodiscard]] const std::array<double, 3>& scale() const { return scale_; }

 protected:
  void SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                 vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

 private:
  void draw(vtkRenderer* renderer, vtkActor* actor);
  void draw_reversed(vtkRenderer* renderer, vtkActor* actor);

  bool greater_is_nearer_ = false, zero_to_one_ = false;
  std::array<float, 16> clip_from_held_{};
  std::array<double, 3> shift_{0, 0, 0}, scale_{1, 1, 1};
  std::optional<EqualDepths> equal_depths_;
  std::uint32_t width_ = 0, height_ = 0;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace fathom::validation
