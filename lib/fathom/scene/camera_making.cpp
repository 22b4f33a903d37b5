#include "fathom/scene/camera_making.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/pose.h"

namespace fathom {
namespace {

/// The part of the image's width and height that framed bounds may fill.
constexpr double filled = 0.9;

void expect(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void expect_finite(const Vector3& v, const std::string& name) {
  for (const double x : v) expect(std::isfinite(x), name + " is not finite");
}

/// A camera with the intrinsics of a lens, at the world's origin.
Camera with_lens(const Lens& lens) {
  Camera camera;
  camera.width = lens.width;
  camera.height = lens.height;
  camera.projection = lens.projection;
  camera.cx = lens.width / 2.0;
  camera.cy = lens.height / 2.0;
  camera.near = lens.near;
  camera.far = lens.far;
  if (lens.projection == Projection::orthographic) {
    expect(lens.vertical_extent.has_value(), "an orthographic camera needs a vertical extent");
    expect(*lens.vertical_extent > 0, "the vertical extent must be greater than 0");
    camera.fx = lens.height / *lens.vertical_extent;
  } else if (lens.focal) {
    expect(*lens.focal > 0, "the focal length must be greater than 0");
    camera.fx = *lens.focal;
  } else {
    expect(lens.vertical_fov > 0 && lens.vertical_fov < 180,
           "the field of view must be between 0 and 180 degrees");
    camera.fx = lens.height / 2.0 / std::tan(lens.vertical_fov * (std::numbers::pi / 360));
  }
  camera.fy = camera.fx;
  return camera;
}

Camera checked(Camera camera) {
  if (const auto fault = find_fault(camera)) throw UsageError("no such camera: " + *fault);
  return camera;
}

struct SineCosine {
  double sine, cosine;
};

/// Exact at multiples of 90 degrees.
SineCosine sine_and_cosine(double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter) * (std::numbers::pi / 180);
  const double s = std::sin(rest), c = std::cos(rest);
  switch (quarter & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// Rows right, down, forward in the world.
Matrix3 rotation_of(const View& view) {
  expect(std::isfinite(view.azimuth), "the azimuth is not finite");
  expect(view.elevation >= -90 && view.elevation <= 90,
         "the elevation must be between -90 and 90 degrees");
  const auto [sa, ca] = sine_and_cosine(view.azimuth);
  const auto [se, ce] = sine_and_cosine(view.elevation);
  // With y up the eye is at (ce·sa, se, ce·ca) from what it looks at.
  const Matrix3 y_up{{{ca, 0, -sa}, {se * sa, -ce, se * ca}, {-ce * sa, -se, -ce * ca}}};
  if (view.up == UpAxis::y) return y_up;
  // z up: (x, y, z) of the frame above is (x, −z, y) here, so x' = x, y' = −z, z' = y.
  Matrix3 z_up;
  for (int i = 0; i < 3; ++i) z_up[i] = {y_up[i][0], -y_up[i][2], y_up[i][1]};
  return z_up;
}

ExactVector3 exactly(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

/// Bounds around their middle: what framing needs of them.
struct Box {
  ExactVector3 middle;
  std::array<ExactVector3, 8> corners;
};

Box box_of(const WorldBounds& bounds) {
  expect_finite(bounds.lower, "a bound of the scene");
  expect_finite(bounds.upper, "a bound of the scene");
  Box box;
  for (int k = 0; k < 3; ++k)
    box.middle[k] = (Dyadic(bounds.lower[k]) + Dyadic(bounds.upper[k])).scaled(-1);
  for (unsigned i = 0; i < 8; ++i)
    for (unsigned k = 0; k < 3; ++k)
      box.corners[i][k] = ((i >> k) & 1) != 0 ? bounds.upper[k] : bounds.lower[k];
  return box;
}

/// Whether every corner projects into the part of the image that may be filled. Projection takes
/// segments in front of the camera to segments, so then every point between them does. Exact.
bool sees_corners(const Camera& camera, const Box& box) {
  const Dyadic reach_u = Dyadic(camera.width) * Dyadic(filled / 2);
  const Dyadic reach_v = Dyadic(camera.height) * Dyadic(filled / 2);
  return std::all_of(box.corners.begin(), box.corners.end(), [&](const ExactVector3& corner) {
    const CameraPoint p = to_camera(camera, {corner[0], corner[1], corner[2]});
    const auto [U, V, W] = to_image(camera, p);
    return p.z.sign() == Sign::positive && abs(U - Dyadic(camera.cx) * W) <= reach_u * W &&
           abs(V - Dyadic(camera.cy) * W) <= reach_v * W;
  });
}

bool in_front(const Camera& camera, const Box& box) {
  return std::all_of(box.corners.begin(), box.corners.end(), [&](const ExactVector3& c) {
    return to_camera(camera, {c[0], c[1], c[2]}).z.sign() == Sign::positive;
  });
}

/// How far away a camera stands, and (orthographic) how much it sees.
struct Placement {
  double distance = 1;
  double vertical_extent = 1;
};

/// An estimate in floating point of the least placement that frames the box; the caller proves it.
Placement estimate_placement(const Box& box, const Matrix3& R, const Lens& lens) {
  std::array<ExactVector3, 8> offsets;
  long power = 0;  // of two, of the largest coordinate
  bool single_point = true;
  for (int i = 0; i < 8; ++i) {
    const auto& c = box.corners[i];
    offsets[i] = rotate(R, {c[0] - box.middle[0], c[1] - box.middle[1], c[2] - box.middle[2]});
    for (const Dyadic& x : offsets[i]) {
      if (x.is_zero()) continue;
      const long bits = static_cast<long>(mpz_sizeinbase(x.significand(), 2)) + x.exponent();
      power = single_point ? bits : std::max(power, bits);
      single_point = false;
    }
  }
  if (single_point) return {};
  const Camera camera = with_lens(lens);
  const double reach_x = filled / 2 * camera.width / camera.fx;
  const double reach_y = filled / 2 * camera.height / camera.fy;
  double distance = 0, half_height = 0, radius = 0;
  for (const ExactVector3& offset : offsets) {
    const auto scaled = [&](int k) { return round_to_binary64(Ratio(offset[k].scaled(-power))); };
    const double x = std::abs(scaled(0)), y = std::abs(scaled(1)), z = scaled(2);
    distance = std::max({distance, x / reach_x - z, y / reach_y - z});
    half_height = std::max({half_height, y, x * lens.height / lens.width});
    radius = std::max(radius, std::hypot(x, y, z));
  }
  if (half_height == 0) half_height = radius;  // a line seen end on
  // Half a radius in front of a box that is thin across the view or seen through a wide lens.
  if (lens.projection == Projection::orthographic) distance = 0;
  distance = std::max(distance, 1.5 * radius) * (1 + 0x1p-40);
  const auto unscaled = [&](double x) { return round_to_binary64(Ratio(Dyadic(x).scaled(power))); };
  return {unscaled(distance), unscaled(2 / filled * half_height * (1 + 0x1p-40))};
}

/// A quarter more; also of 0 and of numbers so small that a quarter of them rounds away.
double larger(double x) {
  return std::max(1.25 * x, std::nextafter(x, std::numeric_limits<double>::infinity()));
}

Camera place(const Box& box, const Matrix3& R, const Lens& lens, double distance) {
  Camera camera = with_lens(lens);
  camera.world_to_camera = pose_that_takes(R, box.middle, {0.0, 0.0, distance});
  return camera;
}

}  // namespace

Camera look_at(const Vector3& eye, const Vector3& target, const Vector3& up, const Lens& lens) {
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

Camera look_from(const View& view, const Vector3& centre, double distance, const Lens& lens) {
  expect_finite(centre, "the centre");
  expect(distance > 0 && std::isfinite(distance), "the distance must be greater than 0");
  Camera camera = with_lens(lens);
  camera.world_to_camera =
      pose_that_takes(rotation_of(view), exactly(centre), {0.0, 0.0, distance});
  return checked(camera);
}

namespace {

/// A path is held in memory and written as one file.
constexpr std::uint32_t longest_path = 1'000'000;

void expect_count(std::uint32_t count) {
  expect(count >= 1 && count <= longest_path,
         "a camera path has from 1 to " + std::to_string(longest_path) + " cameras");
}

View turned(View view, std::uint32_t step, std::uint32_t count) {
  view.azimuth += 360.0 * step / count;
  return view;
}

}  // namespace

std::vector<Camera> orbit(const View& first, std::uint32_t count, const Vector3& centre,
                          double distance, const Lens& lens) {
  expect_count(count);
  std::vector<Camera> path;
  for (std::uint32_t i = 0; i < count; ++i)
    path.push_back(look_from(turned(first, i, count), centre, distance, lens));
  return path;
}

std::vector<Camera> orbit(const View& first, std::uint32_t count, const WorldBounds& bounds,
                          const Lens& lens) {
  expect_count(count);
  const Box box = box_of(bounds);
  const bool extent_is_free = lens.projection == Projection::orthographic && !lens.vertical_extent;
  Lens chosen = lens;
  if (extent_is_free) chosen.vertical_extent = 1;
  checked(with_lens(chosen));
  std::vector<Matrix3> rotations;
  Placement placement{0, 0};
  for (std::uint32_t i = 0; i < count; ++i) {
    rotations.push_back(rotation_of(turned(first, i, count)));
    const Placement one = estimate_placement(box, rotations.back(), chosen);
    placement.distance = std::max(placement.distance, one.distance);
    placement.vertical_extent = std::max(placement.vertical_extent, one.vertical_extent);
  }
  const bool all_must_be_seen = lens.projection == Projection::perspective || extent_is_free;
  // Rounding of the pose can move a small scene that is far from the origin out of the picture;
  // then farther away will do.
  for (; std::isfinite(placement.distance);
       placement = {larger(placement.distance), larger(placement.vertical_extent)}) {
    if (extent_is_free) chosen.vertical_extent = placement.vertical_extent;
    std::vector<Camera> path;
    for (const Matrix3& R : rotations) {
      const Camera camera = place(box, R, chosen, placement.distance);
      if (find_fault(camera)) break;
      if (all_must_be_seen ? !sees_corners(camera, box) : !in_front(camera, box)) break;
      path.push_back(camera);
    }
    if (path.size() == count) return path;
  }
  throw InputError("no camera with finite numbers sees the whole scene");
}

Camera frame(const WorldBounds& bounds, const View& view, const Lens& lens) {
  return orbit(view, 1, bounds, lens).front();
}

Camera frame_scene(const Scene& scene, const View& view, const Lens& lens) {
  const auto bounds = world_bounds(scene);
  if (!bounds) throw InputError("the scene has no triangle that a camera could frame");
  return frame(*bounds, view, lens);
}

}  // namespace fathom
