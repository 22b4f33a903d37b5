#pragma once

#include <cstdint>
#include <vector>

#include "fathom/attribution/world_mesh.h"
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

}  // namespace fathom::validation
