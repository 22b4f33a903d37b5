#include "fathom/vtk/drawn_scene.h"

#include <vtkActor.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "fathom/camera/camera_import.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"

namespace fathom::vtk {
namespace {

/// VTK stores matrices for OpenGL column by column.
std::array<double, 16> rows_of(vtkMatrix4x4& columns) {
  std::array<double, 16> rows{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) rows.at(4 * r + c) = columns.GetElement(c, r);
  }
  return rows;
}

}  // namespace

Camera camera_of(vtkRenderer& renderer) {
  auto* const theirs = vtkOpenGLCamera::SafeDownCast(renderer.GetActiveCamera());
  if (theirs == nullptr) throw InputError("the renderer's camera is not a vtkOpenGLCamera");
  vtkMatrix4x4 *view = nullptr, *projection = nullptr, *both = nullptr;
  vtkMatrix3x3* normals = nullptr;
  theirs->GetKeyMatrices(&renderer, view, normals, projection, both);
  int width = 0, height = 0, left = 0, bottom = 0;
  renderer.GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  return camera_from_opengl(rows_of(*projection), rows_of(*view), static_cast<std::uint32_t>(width),
                            static_cast<std::uint32_t>(height));
}

namespace {

/// Fewer than 2⁷ roundings to binary64, of VTK and here, lose less than this of the terms.
constexpr double lost = 0x1p-45;

bool is_given_by_matrices(vtkCamera& c) {
  const double* const shear = c.GetViewShear();
  return c.GetUserViewTransform() != nullptr || c.GetUseExplicitProjectionTransformMatrix() ||
         c.GetUserTransform() != nullptr || c.GetUseOffAxisProjection() != 0 || shear[0] != 0 ||
         shear[1] != 0;
}

std::array<double, 3> array_of(const double* v) {
  return {v[0], v[1], v[2]};
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Its intrinsics and view, without the model transform.
Camera described(vtkCamera& c, std::uint32_t width, std::uint32_t height) {
  LensChoice lens{.width = width, .height = height};
  if (c.GetParallelProjection() != 0) {
    lens.model = ProjectionModel::orthographic;
    lens.vertical_extent = 2 * c.GetParallelScale();
  } else {
    const double spanned = c.GetUseHorizontalViewAngle() != 0 ? width : height;
    lens.focal = spanned / 2 / std::tan(c.GetViewAngle() / 2 * std::numbers::pi / 180);
  }
  Camera camera = look_at(array_of(c.GetPosition()), array_of(c.GetFocalPoint()),
                          array_of(c.GetViewUp()), lens);
  camera.projection.cx = (1 - c.GetWindowCenter()[0]) * width / 2;
  camera.projection.cy = (1 + c.GetWindowCenter()[1]) * height / 2;
  camera.near = c.GetClippingRange()[0];
  camera.far = c.GetClippingRange()[1];
  return camera;
}

/// The view after the model transform, and the sums of the magnitudes of its terms.
struct View {
  Pose rows{}, terms{};
};

View with_model(const Camera& camera, vtkCamera& c) {
  const auto eye = array_of(c.GetPosition());
  vtkMatrix4x4* const model = c.GetModelTransformMatrix();
  View view;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& v = camera.world_to_camera[r];
    const double moved =
        std::abs(v[0] * eye[0]) + std::abs(v[1] * eye[1]) + std::abs(v[2] * eye[2]);
    for (std::size_t k = 0; k < 4; ++k) {
      view.rows[r][k] = k == 3 ? v[3] : 0;
      view.terms[r][k] = k == 3 ? moved : 0;
      for (std::size_t j = 0; j < 3; ++j) {
        const double m = model->GetElement(static_cast<int>(j), static_cast<int>(k));
        view.rows[r][k] += v[j] * m;
        // An entry of a rotation is off by parts of the greatest one, 1, not of itself.
        view.terms[r][k] += std::abs(m);
      }
    }
  }
  return view;
}

/// sin² of the angle between view up and line of sight: a frame made of them loses as much more.
double squared_sine(vtkCamera& c) {
  const auto up = array_of(c.GetViewUp());
  const auto from = array_of(c.GetPosition()), to = array_of(c.GetFocalPoint());
  const std::array<double, 3> sight{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double cosine = dot(up, sight);
  return 1 - cosine * cosine / (dot(up, up) * dot(sight, sight));
}

/// Collects the first number that differs from its expected value.
class Check {
 public:
  void expect(const char* what, double is, double should, double terms) {
    if (fault_ || std::abs(is - should) <= lost * terms) return;
    std::ostringstream text;
    text.precision(17);
    text << what << " is " << is << " and should be " << should;
    fault_ = text.str();
  }
  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

 private:
  std::optional<std::string> fault_;
};

void check_clip_planes(Check& check, const Camera& is, const Camera& should) {
  const bool perspective = is_perspective(should.projection);
  const double ratio = perspective ? should.far / should.near : 1;
  check.expect("near", is.near, should.near, 4 * (should.near + (perspective ? 0 : should.far)));
  if (std::isfinite(is.far)) check.expect("far", is.far, should.far, 4 * should.far * (1 + ratio));
}

void check_view(Check& check, const Camera& is, vtkCamera& theirs, const Camera& should) {
  const View view = with_model(should, theirs);
  const double sine = squared_sine(theirs);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string what =
          "row " + std::to_string(r) + ", column " + std::to_string(k) + " of world to camera";
      check.expect(what.c_str(), is.world_to_camera[r][k], view.rows[r][k],
                   view.terms[r][k] / sine);
    }
  }
}

}  // namespace

std::optional<std::string> fault_of_matrices(vtkRenderer& renderer, const Camera& is) {
  vtkCamera& theirs = *renderer.GetActiveCamera();
  if (is_given_by_matrices(theirs)) return std::nullopt;
  try {
    const Camera should = described(theirs, is.width, is.height);
    Check check;
    check.expect("fx, in pixels,", is.projection.fx, should.projection.fx,
                 std::abs(should.projection.fx));
    check.expect("fy, in pixels,", is.projection.fy, should.projection.fy,
                 std::abs(should.projection.fy));
    check.expect("the skew", is.projection.skew, 0, 0);
    check.expect("cx, in pixels,", is.projection.cx, should.projection.cx,
                 is.width + std::abs(should.projection.cx));
    check.expect("cy, in pixels,", is.projection.cy, should.projection.cy,
                 is.height + std::abs(should.projection.cy));
    check_clip_planes(check, is, should);
    check_view(check, is, theirs, should);
    return check.fault();
  } catch (const UsageError& error) {  // of look_at(): nothing follows from its description
    return error.what();
  }
}

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

/// Polygons, as fans from their first corners, and triangle strips, in the order in which VTK draws
/// them; points are exact.
/// Needs    at most 2³² − 1 points.
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

/// Why a prop's depths cannot be compared, as a clause without its subject; empty if it is an actor
/// with only opaque triangles.
/// Needs    its mapper's input to be up to date.
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
