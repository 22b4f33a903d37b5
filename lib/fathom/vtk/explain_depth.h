#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

class vtkRenderWindow;
class vtkRenderer;

/// VTK's depth buffer, explained pixel by pixel: the oracle for a regression test without a
/// baseline. The sources of this library are installed, and users compile them with their own VTK.
namespace fathom::vtk {

/// A prop that is hidden while depth is drawn, and why.
struct LeftOut {
  /// Its class and its place among the renderer's props: "vtkOpenGLActor 3".
  std::string prop;
  /// "is translucent", "has clipping planes", …
  std::string why;
};

/// The result of explain_depth().
struct DepthVerdict {
  /// VTK's depths, the assumed model, the exact map, and the causes of differences. Rows from the
  /// top; depths in scene units.
  attribution::OtherMap map;
  attribution::RendererModel model;
  attribution::Truth truth;
  attribution::Attribution attribution;
  std::vector<LeftOut> left_out;
  /// The fault, in one line; empty if every pixel is explained and no fault was found.
  std::string cause;

  [[nodiscard]] bool is_good() const { return cause.empty(); }
};

/// Prints the cause, or that all pixels are explained, then the pixels of each class and the props
/// that were left out: a line each.
std::ostream& operator<<(std::ostream& out, const DepthVerdict& verdict);

/// Renders the window and compares the depth buffer with the exact depths of its renderer's scene.
///
/// Takes       from VTK itself: polygons and triangle strips of the actors (also in assemblies)
///             that a vtkPolyDataMapper draws, their matrices, the camera's matrices, viewport,
///             depth buffer and its type, sample position, and how mappers shift and scale
///             coordinates. A polygon of more than three corners is the fan from its first corner,
///             as VTK draws it.
/// Checks too  that the camera's matrices follow from its position, focal point, view up, view
///             angle or parallel scale, window centre and clipping range (cameras with a user
///             transform or an explicit projection are trusted).
/// Leaves out  everything but opaque triangles, each omission named in the verdict: translucent
///             actors, actors with clipping planes, visible edges, culled faces, lines, vertices,
///             wireframes or points, user shaders, polygon offsets, hidden cells; glyphs, composite
///             mappers, volumes, annotations and other props. They are hidden for a single Render()
///             and shown again afterwards.
/// Exact       the truth and the bounds, as attribute_and_name().
/// Fails       InputError, one line: if nothing is left to compare, VTK has no OpenGL, stereo or
///             more than one layer is drawn, or the camera cannot be expressed.
/// Threads     call it in the thread of the window's context.
DepthVerdict explain_depth(vtkRenderWindow& window, vtkRenderer& renderer);

}  // namespace fathom::vtk
