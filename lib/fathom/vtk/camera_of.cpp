#include "fathom/vtk/camera_of.h"

#include <vtkCamera.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLCamera.h>
#include <vtkRenderer.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fathom/camera/camera_import.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"

namespace fathom::vtk {
namespace {

/// VTK keeps those for OpenGL column by column.
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

/// Collects the first number that is not what it should be.
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

}  // namespace fathom::vtk
