#include "fathom/vtk/reason_to_leave_out.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace fathom::vtk {
namespace {

bool has_mark(vtkUnsignedCharArray* marks) {
  if (marks == nullptr) return false;
  const auto* const first = marks->GetPointer(0);
  return std::any_of(first, first + marks->GetNumberOfValues(), [](auto m) { return m != 0; });
}

std::string reason_of_data(vtkPolyData& data) {
  if (data.GetNumberOfLines() > 0) return "has lines";
  if (data.GetNumberOfVerts() > 0) return "has vertices";
  if (has_mark(data.GetCellGhostArray()) || has_mark(data.GetPointGhostArray())) {
    return "has hidden or ghost cells";
  }
  return "";
}

std::string reason_of_property(vtkProperty& property) {
  if (property.GetRepresentation() != VTK_SURFACE) return "is drawn as points or lines";
  if (property.GetEdgeVisibility() != 0) return "has visible edges";
  if (property.GetVertexVisibility() != 0) return "has visible vertices";
  if (property.GetBackfaceCulling() != 0 || property.GetFrontfaceCulling() != 0) {
    return "culls faces";
  }
  return "";
}

/// By name, since not every VTK has all of them.
template <std::size_t count>
bool is_one_of(vtkObject& object, const char* const (&classes)[count]) {
  return std::any_of(classes, classes + count,
                     [&](const char* name) { return object.IsA(name) != 0; });
}

/// Mappers of VTK's that are vtkOpenGLPolyDataMappers and draw something else than their input's
/// polygons.
constexpr const char* other_mappers[] = {"vtkCompositePolyDataMapper2", "vtkOpenGLSphereMapper",
                                         "vtkOpenGLStickMapper"};
/// Actors that draw by other mappers than their own where time is short.
constexpr const char* actors_of_levels[] = {"vtkLODActor", "vtkQuadricLODActor"};

bool has_code(vtkShaderProperty& shaders) {
  return shaders.HasVertexShaderCode() || shaders.HasFragmentShaderCode() ||
         shaders.HasGeometryShaderCode() || shaders.GetNumberOfShaderReplacements() > 0;
}

bool is_affine(vtkMatrix4x4* matrix) {
  return matrix == nullptr || (matrix->GetElement(3, 0) == 0 && matrix->GetElement(3, 1) == 0 &&
                               matrix->GetElement(3, 2) == 0 && matrix->GetElement(3, 3) == 1);
}

std::string reason_of_mapper(vtkOpenGLPolyDataMapper& mapper) {
  vtkPlaneCollection* const planes = mapper.GetClippingPlanes();
  if (planes != nullptr && planes->GetNumberOfItems() > 0) return "has clipping planes";
  if (vtkMapper::GetResolveCoincidentTopology() != VTK_RESOLVE_OFF) {
    return "is drawn with coincident topology resolved, which moves depths";
  }
  return mapper.GetInput() == nullptr ? "has no input" : reason_of_data(*mapper.GetInput());
}

}  // namespace

std::string reason_to_leave_out(vtkProp& prop) {
  auto* const actor = vtkActor::SafeDownCast(&prop);
  if (actor == nullptr) return "is no actor";
  if (actor->GetMapper() == nullptr) return "has no mapper";
  auto* const mapper = vtkOpenGLPolyDataMapper::SafeDownCast(actor->GetMapper());
  if (mapper == nullptr || is_one_of(*mapper, other_mappers)) {
    return std::string("is drawn by a ") + actor->GetMapper()->GetClassName() +
           ", not a vtkPolyDataMapper";
  }
  if (is_one_of(*actor, actors_of_levels)) return "chooses its level of detail by time";
  if (!is_affine(prop.GetMatrix())) return "has a matrix that is not affine";
  if (actor->HasTranslucentPolygonalGeometry() != 0) return "is translucent";
  if (has_code(*actor->GetShaderProperty())) return "has custom shader code";
  const std::string reason = reason_of_property(*actor->GetProperty());
  return reason.empty() ? reason_of_mapper(*mapper) : reason;
}

}  // namespace fathom::vtk
