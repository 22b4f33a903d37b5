#include "fathom/vtk/drawn_scene.h"

#include <vtkActor.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPolyData.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

#include <memory>
#include <string>
#include <utility>

#include "fathom/vtk/reason_to_leave_out.h"
#include "fathom/vtk/triangles_of.h"

namespace fathom::vtk {
namespace {

std::array<std::array<double, 4>, 3> affine_of(vtkMatrix4x4* matrix) {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  if (matrix == nullptr) return rows;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) rows.at(r).at(c) = matrix->GetElement(r, c);
  }
  return rows;
}

WorldFromMesh exact(const std::array<std::array<double, 4>, 3>& rows) {
  WorldFromMesh placement;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 4; ++c) placement.rows[r][c] = rows[r][c];
  }
  return placement;
}

std::shared_ptr<const std::vector<std::array<double, 3>>> points_of(const Mesh& mesh) {
  auto points = std::make_shared<std::vector<std::array<double, 3>>>();
  for (const MeshPoint& p : mesh.vertices) points->push_back({p.x, p.y, p.z});
  return points;
}

void add_actor(DrawnScene& drawn, vtkOpenGLPolyDataMapper& mapper, vtkMatrix4x4* matrix,
               const std::string& name) {
  Mesh mesh = triangles_of(*mapper.GetInput());
  if (mesh.triangles.empty()) return;
  const auto placement = affine_of(matrix);
  drawn.parts.push_back({.world_from_part = placement, .points = points_of(mesh)});
  drawn.mappers.emplace_back(&mapper);
  drawn.scene.objects.push_back({.mesh = drawn.scene.meshes.size(),
                                 .world_from_mesh = exact(placement),
                                 .placed_as_is = placement == affine_of(nullptr),
                                 .name = name});
  drawn.scene.meshes.push_back(std::move(mesh));
}

void add(DrawnScene& drawn, vtkProp& prop, vtkMatrix4x4* matrix, const std::string& place) {
  if (prop.GetVisibility() == 0) return;
  const std::string name = prop.GetClassName() + (" " + place);
  auto* const actor = vtkActor::SafeDownCast(&prop);
  vtkMapper* const mapper = actor == nullptr ? nullptr : actor->GetMapper();
  if (mapper != nullptr) mapper->Update();
  std::string reason = reason_to_leave_out(prop);
  if (reason.empty()) {
    add_actor(drawn, *vtkOpenGLPolyDataMapper::SafeDownCast(mapper), matrix, name);
  } else {
    drawn.left_out.push_back({name, std::move(reason)});
    drawn.to_hide.emplace_back(&prop);
  }
}

}  // namespace

DrawnScene drawn_scene(vtkRenderer& renderer) {
  DrawnScene drawn;
  vtkPropCollection* const props = renderer.GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i) {
    auto* const prop = vtkProp::SafeDownCast(props->GetItemAsObject(i));
    if (prop == nullptr || prop->GetVisibility() == 0) continue;
    prop->InitPathTraversal();
    int part = 0;
    while (vtkAssemblyPath* const path = prop->GetNextPath()) {
      vtkAssemblyNode* const leaf = path->GetLastNode();
      std::string place = std::to_string(i);
      if (leaf->GetViewProp() != prop) place += "." + std::to_string(part++);
      add(drawn, *leaf->GetViewProp(), leaf->GetMatrix(), place);
    }
  }
  return drawn;
}

}  // namespace fathom::vtk
