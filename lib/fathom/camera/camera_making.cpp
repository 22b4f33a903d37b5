#include "fathom/camera/camera_making.h"

#include <cmath>
#include <string>

#include "fathom/camera/camera_making_internal.h"
#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace camera {
namespace {

/// A path is held in memory and written as one file.
constexpr std::uint32_t longest_path = 1'000'000;

void expect(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

ExactVector3 exactly(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

/// The frame of azimuth and elevation: rows right (of the image at
/// azimuth 0), up, and back, towards the eye. Orthonormal up to one rounding of each entry; exact
/// where `up` is along an axis.
Matrix3 frame_of(const Vector3& up) {
  expect_finite(up, "the up direction");
  const bool along_x = up[1] == 0 && up[2] == 0;
  expect(!along_x || up[0] != 0, "the up direction is zero");
  const ExactVector3 upwards = exactly(up);
  const ExactVector3 back = cross(exactly(along_x ? Vector3{0, 1, 0} : Vector3{1, 0, 0}), upwards);
  return {unit_vector(cross(upwards, back)), unit_vector(upwards), unit_vector(back)};
}

/// a·b, rounded once. A single product needs no exact number, and keeps the sign of its zero.
double product_rounded_once(const Vector3& a, const Vector3& b) {
  Dyadic sum;
  double last = 0;
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    if (b[k] == 0) continue;
    last = a[k] * b[k];
    sum = sum + Dyadic(a[k]) * Dyadic(b[k]);
    ++count;
  }
  return count == 1 ? last : round_to_binary64(Ratio(sum));
}

/// A panorama of the full turn; a cylinder keeps the focal length that its height has.
void show_full_turn(Camera& camera, const LensChoice& lens) {
  camera.projection.fx = camera.width;
  if (lens.distortion->model != LensModel::equirectangular) return;
  expect(!lens.focal, "EQUIRECTANGULAR has no focal length");
  camera.projection.fy = camera.height;
}

}  // namespace

void expect_finite(const Vector3& v, const std::string& name) {
  for (const double x : v) expect(std::isfinite(x), name + " is not finite");
}

Camera with_lens(const LensChoice& lens) {
  Camera camera;
  camera.width = lens.width;
  camera.height = lens.height;
  camera.projection.model = lens.model;
  camera.projection.cx = lens.width / 2.0;
  camera.projection.cy = lens.height / 2.0;
  camera.near = lens.near;
  camera.far = lens.far;
  if (lens.model == ProjectionModel::orthographic) {
    expect(lens.vertical_extent.has_value(), "an orthographic camera needs a vertical extent");
    expect(*lens.vertical_extent > 0, "the vertical extent must be greater than 0");
    camera.projection.fx = lens.height / *lens.vertical_extent;
  } else if (lens.focal) {
    expect(*lens.focal > 0, "the focal length must be greater than 0");
    camera.projection.fx = *lens.focal;
  } else {
    expect(lens.vertical_fov > 0 && lens.vertical_fov < 180,
           "the field of view must be between 0 and 180 degrees");
    camera.projection.fx = focal_of_degrees(lens.height, lens.vertical_fov);
  }
  camera.projection.fy = camera.projection.fx;
  camera.projection.lens = lens.distortion;
  if (lens.distortion && is_panorama(lens.distortion->model)) show_full_turn(camera, lens);
  return camera;
}

Camera checked(Camera camera) {
  if (const auto fault = find_fault(camera)) throw UsageError("no such camera: " + *fault);
  return camera;
}

Matrix3 rotation_of(const View& view) {
  expect(std::isfinite(view.azimuth), "the azimuth is not finite");
  expect(view.elevation >= -90 && view.elevation <= 90,
         "the elevation must be between -90 and 90 degrees");
  const auto [sa, ca] = sine_and_cosine(view.azimuth);
  const auto [se, ce] = sine_and_cosine(view.elevation);
  // In the frame of `up` the eye is at (ce·sa, se, ce·ca) from the point that it looks at.
  const Matrix3 turn{{{ca.rounded, 0, -sa.rounded},
                      {rounded_product(se, sa), -ce.rounded, rounded_product(se, ca)},
                      {rounded_product(-ce, sa), -se.rounded, rounded_product(-ce, ca)}}};
  const Matrix3 frame = frame_of(view.up);
  Matrix3 R;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      R[i][k] = product_rounded_once(turn[i], {frame[0][k], frame[1][k], frame[2][k]});
  return R;
}

void expect_count(std::uint32_t count) {
  expect(count >= 1 && count <= longest_path,
         "a camera path has from 1 to " + std::to_string(longest_path) + " cameras");
}

View turned(View view, std::uint32_t step, std::uint32_t count) {
  expect(std::isfinite(view.azimuth), "the azimuth is not finite");
  const Ratio turn(Dyadic(360.0) * Dyadic(step), Dyadic(count));
  view.azimuth = round_to_binary64(Ratio(view.azimuth) + turn);
  return view;
}

}  // namespace camera

using namespace camera;

Camera look_at(const Vector3& eye, const Vector3& target, const Vector3& up,
               const LensChoice& lens) {
  const StandardArithmetic standard;
  expect_finite(eye, "the eye");
  expect_finite(target, "the target");
  expect_finite(up, "the up direction");
  ExactVector3 forward;
  for (int k = 0; k < 3; ++k) forward[k] = Dyadic(target[k]) - Dyadic(eye[k]);
  expect(!dot(forward, forward).is_zero(), "eye and target are the same point");
  const ExactVector3 right = cross(forward, exactly(up));
  expect(!dot(right, right).is_zero(), "the up direction is zero or along the line of sight");
  const ExactVector3 down = cross(forward, right);
  const Matrix3 R{unit_vector(right), unit_vector(down), unit_vector(forward)};
  Camera camera = with_lens(lens);
  camera.world_to_camera = pose_that_takes(R, exactly(eye), {});
  return checked(camera);
}

Camera look_from(const View& view, const Vector3& centre, double distance, const LensChoice& lens) {
  const StandardArithmetic standard;
  expect_finite(centre, "the centre");
  expect(distance > 0 && std::isfinite(distance), "the distance must be greater than 0");
  Camera camera = with_lens(lens);
  camera.world_to_camera =
      pose_that_takes(rotation_of(view), exactly(centre), {0.0, 0.0, distance});
  return checked(camera);
}

std::vector<Camera> orbit(const View& first, std::uint32_t count, const Vector3& centre,
                          double distance, const LensChoice& lens,
                          const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  expect_count(count);
  std::vector<Camera> path;
  for (std::uint32_t i = 0; i < count; ++i) {
    path.push_back(look_from(turned(first, i, count), centre, distance, lens));
    if (progress) progress((i + 1.0) / count);
  }
  return path;
}

}  // namespace fathom
