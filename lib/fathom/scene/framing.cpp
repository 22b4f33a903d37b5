#include "fathom/scene/framing.h"

#include <algorithm>
#include <cmath>

#include "fathom/camera/camera_making_internal.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/bounds.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;

namespace {

double reach_of(const WorldBounds& bounds) {
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis)
    reach = std::max({reach, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
  return reach;
}

/// The object that reaches farthest from the origin of the world, the first of several, for the
/// message that no camera frames the scene: "FILE: object NAME". The scene has a triangle.
std::string name_of_farthest_object(const Scene& scene) {
  const Object* farthest = nullptr;
  double farthest_reach = -1;
  Scene part;
  part.meshes.resize(1);
  const Mesh* copied = nullptr;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    if (copied != &mesh) part.meshes[0] = mesh;
    copied = &mesh;
    part.objects = {object};
    part.objects[0].mesh = 0;
    const auto bounds = world_bounds(part);
    if (!bounds || !(reach_of(*bounds) > farthest_reach)) continue;
    farthest = &object;
    farthest_reach = reach_of(*bounds);
  }
  if (farthest == nullptr) return "the scene";
  std::string object = "object " + text::printable(farthest->name);
  if (farthest->source >= scene.sources.size()) return object;
  return scene.sources[farthest->source].path + ": " + object;
}

/// The part of the image's width and height that framed bounds may fill.
constexpr double filled = 0.9;

/// What framing needs of bounds.
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
/// segments in front of the camera to segments, so every point between the corners then does too.
/// Exact.
bool sees_corners(const Camera& camera, const Box& box) {
  const Dyadic reach_u = Dyadic(camera.width) * Dyadic(filled / 2);
  const Dyadic reach_v = Dyadic(camera.height) * Dyadic(filled / 2);
  return std::all_of(box.corners.begin(), box.corners.end(), [&](const ExactVector3& corner) {
    const CameraPoint p = to_camera(camera.world_to_camera, {corner[0], corner[1], corner[2]});
    const auto [U, V, W] = to_image(camera.projection, p);
    return p.z.sign() == Sign::positive &&
           abs(U - Dyadic(camera.projection.cx) * W) <= reach_u * W &&
           abs(V - Dyadic(camera.projection.cy) * W) <= reach_v * W;
  });
}

bool in_front(const Camera& camera, const Box& box) {
  return std::all_of(box.corners.begin(), box.corners.end(), [&](const ExactVector3& c) {
    return to_camera(camera.world_to_camera, {c[0], c[1], c[2]}).z.sign() == Sign::positive;
  });
}

/// How far away a camera is, and (orthographic) how much it sees.
struct Placement {
  double distance = 1;
  double vertical_extent = 1;
};

/// An estimate in floating point of the least placement that frames the box; the caller proves it.
Placement estimate_placement(const Box& box, const Matrix3& R, const LensChoice& lens) {
  std::array<ExactVector3, 8> offsets;
  long power = 0;  // of two, of the largest coordinate
  bool single_point = true;
  for (int i = 0; i < 8; ++i) {
    const auto& c = box.corners[i];
    offsets[i] = rotate(R, {c[0] - box.middle[0], c[1] - box.middle[1], c[2] - box.middle[2]});
    for (const Dyadic& x : offsets[i]) {
      if (x.is_zero()) continue;
      power = single_point ? x.top() : std::max(power, x.top());
      single_point = false;
    }
  }
  if (single_point) return {};
  const Camera camera = with_lens(lens);
  const double reach_x = filled / 2 * camera.width / camera.projection.fx;
  const double reach_y = filled / 2 * camera.height / camera.projection.fy;
  double distance = 0, half_height = 0, radius = 0;
  for (const ExactVector3& offset : offsets) {
    const auto scaled = [&](int k) { return round_to_binary64(Ratio(offset[k].scaled(-power))); };
    const double x = std::abs(scaled(0)), y = std::abs(scaled(1)), z = scaled(2);
    distance = std::max({distance, x / reach_x - z, y / reach_y - z});
    half_height = std::max({half_height, y, x * lens.height / lens.width});
    radius = std::max(radius, std::hypot(x, y, z));
  }
  if (half_height == 0) half_height = radius;  // a line seen end on
  // Stay half a radius in front of a box that is thin across the view or seen through a wide lens.
  if (lens.model == ProjectionModel::orthographic) distance = 0;
  distance = std::max(distance, 1.5 * radius) * (1 + 0x1p-40);
  const auto unscaled = [&](double x) { return round_to_binary64(Ratio(Dyadic(x).scaled(power))); };
  return {unscaled(distance), unscaled(2 / filled * half_height * (1 + 0x1p-40))};
}

/// A quarter more; more also where x is 0 or so small that a quarter of it rounds away.
double larger(double x) {
  return std::max(1.25 * x, std::nextafter(x, std::numeric_limits<double>::infinity()));
}

bool are_finite(const WorldBounds& bounds) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  return std::all_of(bounds.lower.begin(), bounds.lower.end(), is_finite) &&
         std::all_of(bounds.upper.begin(), bounds.upper.end(), is_finite);
}

Camera place(const Box& box, const Matrix3& R, const LensChoice& lens, double distance) {
  Camera camera = with_lens(lens);
  camera.world_to_camera = pose_that_takes(R, box.middle, {0.0, 0.0, distance});
  return camera;
}

/// Framing computes for the pinhole: a panorama has no image of the scene's corners.
LensChoice without_panorama(LensChoice lens) {
  if (lens.distortion && is_panorama(lens.distortion->model)) lens.distortion.reset();
  return lens;
}

}  // namespace

std::vector<Camera> orbit(const View& first, std::uint32_t count, const WorldBounds& bounds,
                          const LensChoice& lens, const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  expect_count(count);
  const Box box = box_of(bounds);
  const bool extent_is_free = lens.model == ProjectionModel::orthographic && !lens.vertical_extent;
  LensChoice chosen = without_panorama(lens);
  if (extent_is_free) chosen.vertical_extent = 1;
  checked(with_lens(chosen));
  std::vector<Matrix3> rotations;
  Placement placement{0, 0};
  for (std::uint32_t i = 0; i < count; ++i) {
    rotations.push_back(rotation_of(turned(first, i, count)));
    const Placement one = estimate_placement(box, rotations.back(), chosen);
    placement.distance = std::max(placement.distance, one.distance);
    placement.vertical_extent = std::max(placement.vertical_extent, one.vertical_extent);
    if (progress) progress((i + 1.0) / count / 4);  // about a quarter of the work
  }
  const bool all_must_be_seen = lens.model == ProjectionModel::perspective || extent_is_free;
  // Rounding of the pose can move a small scene that is far from the origin out of the picture;
  // moving farther away mends that.
  for (; std::isfinite(placement.distance);
       placement = {larger(placement.distance), larger(placement.vertical_extent)}) {
    if (extent_is_free) chosen.vertical_extent = placement.vertical_extent;
    std::vector<Camera> path;
    for (const Matrix3& R : rotations) {
      const Camera camera = place(box, R, chosen, placement.distance);
      if (find_fault(camera)) break;
      if (all_must_be_seen ? !sees_corners(camera, box) : !in_front(camera, box)) break;
      path.push_back(camera);
      if (progress) progress(0.25 + 0.75 * static_cast<double>(path.size()) / count);
    }
    if (path.size() != count) continue;
    if (!lens.distortion) return path;
    const Projection bent = with_lens(lens).projection;
    for (Camera& camera : path) camera.projection = bent;
    return path;
  }
  throw InputError("no camera with finite numbers sees the whole scene");
}

Camera frame(const WorldBounds& bounds, const View& view, const LensChoice& lens) {
  const StandardArithmetic standard;
  return orbit(view, 1, bounds, lens).front();
}

std::vector<Camera> orbit_scene(const View& first, std::uint32_t count, const Scene& scene,
                                const LensChoice& lens,
                                const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  const auto bounds = world_bounds(scene);
  if (!bounds) throw InputError("the scene has no triangle that a camera could frame");
  if (!are_finite(*bounds))
    throw InputError(name_of_farthest_object(scene) +
                     ": reaches beyond the largest binary64 number, where no camera frames it");
  try {
    return orbit(first, count, *bounds, lens, progress);
  } catch (const InputError& error) {
    throw InputError(name_of_farthest_object(scene) + ": " + error.what());
  }
}

Camera frame_scene(const Scene& scene, const View& view, const LensChoice& lens) {
  const StandardArithmetic standard;
  return orbit_scene(view, 1, scene, lens).front();
}

}  // namespace fathom
