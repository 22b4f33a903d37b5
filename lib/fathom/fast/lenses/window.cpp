#include "fathom/fast/lenses/window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/fast/lenses/plane_places.h"

namespace fathom::fast {
using place_arithmetic::up;

namespace {

/// Pixels of a window; their coordinates have the bounds of images.
constexpr double most_pixels = 16384;
/// Beside the samples: more than their errors.
constexpr double margin = 2;

/// Coordinates from the camera's axis are below this: the errors of places, which are below
/// ball_share of them (plane_places.cpp), are then less than the margin.
constexpr double most_shift = 0x1p26;
static_assert(most_shift * place_arithmetic::ball_share < margin);

/// The power of two next to a focal length, in its sign; less where the window would be too large
/// or, with places up to `size`, too far from the camera's axis.
double scale_for(double focal_length, double least, double greatest, double size) {
  int exponent = std::clamp(std::ilogb(focal_length), -1000, 500);
  const auto fits = [&] {
    return std::ldexp(greatest - least, exponent) <= most_pixels - 4 * margin &&
           std::ldexp(size, exponent) <= most_shift;
  };
  while (!fits()) --exponent;
  return std::copysign(std::ldexp(1.0, exponent), focal_length);
}

/// One axis of the window: u = scale·x + shift, between `margin` and `pixels` less that.
struct Axis {
  Axis(double focal_length, double least, double greatest, double size)
      : scale(scale_for(focal_length, least, greatest, size)) {
    const double a = scale * least, b = scale * greatest;
    shift = margin - std::floor(std::min(a, b));
    pixels = static_cast<std::uint32_t>(std::ceil(std::max(a, b) + shift + margin));
  }
  double scale, shift;
  std::uint32_t pixels;
};

/// Pixels for a unit of the plane such that there are about as many as samples.
double density_of(const Places::View& view) {
  const double width = view.box.right - view.box.left, height = view.box.bottom - view.box.top;
  const double extent = std::max(width, height), samples = static_cast<double>(view.count);
  if (!(extent > 0)) return 1;
  const double in_line = samples / extent, in_area = std::sqrt(samples / width / height);
  return std::isfinite(in_area) ? std::min(in_line, in_area) : in_line;
}

/// Pixels for a unit of the plane, with the signs that keep orientations.
struct Density {
  Density(const Projection& lens, const Places::View& view) : u(lens.fx), v(lens.fy) {
    if (!counts_distance(lens)) return;
    const double density = density_of(view);
    u = std::copysign(density, lens.fx);
    v = std::copysign(density, lens.fy);
  }
  double u, v;
};

Pose pose_in(const ViewAxes& axes, const Pose& world_to_camera) {
  Pose pose;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto [of_camera, sign] = axes.all()[row];
    for (std::size_t k = 0; k < 4; ++k) pose[row][k] = sign * world_to_camera[of_camera][k];
  }
  return pose;
}

/// The q of ray distances: of a depth D along a view's axis the distance is D·√(1 + a² + b²) at the
/// place (a, b), between D and D·longest. Quotients are rounded, and moved by two numbers for that.
DepthRange distance_range(const Camera& camera, const PlaneBox& box) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double down = 1 - 0x1p-40;
  const double size = box.size() * (1 + lens_bounds::range_room);
  const double longest = std::sqrt(1 + 2 * size * size) * up;
  DepthRange range{-infinity, infinity, -infinity, infinity};
  if (camera.far < infinity) {
    range.inside_least = std::nextafter(longest / camera.far * up, infinity);
    range.outside_least = std::nextafter(1 / camera.far * down, -infinity);
  }
  if (camera.near > 0) {
    range.inside_greatest = std::nextafter(1 / camera.near * down, -infinity);
    range.outside_greatest = std::nextafter(longest / camera.near * up, infinity);
  }
  return range;
}

}  // namespace

Window::Window(const Camera& the_camera, const Places::View& view)
    : camera(the_camera), axes(view.axes), range(depth_range(the_camera)) {
  const PlaneBox& box = view.box;
  // Places err by a share of the greater coordinate.
  const double size = box.size();
  const Density density(the_camera.projection, view);
  const Axis u(density.u, box.left, box.right, size), v(density.v, box.top, box.bottom, size);
  camera.width = u.pixels;
  camera.height = v.pixels;
  camera.projection = {.fx = u.scale, .fy = v.scale, .cx = u.shift, .cy = v.shift};
  camera.world_to_camera = pose_in(axes, the_camera.world_to_camera);
  if (!counts_distance(the_camera.projection)) return;
  range = distance_range(the_camera, box);
  camera.near = Camera().near;
  camera.far = Camera().far;
}

// A product with a power of two is exact, the sum is rounded once: by u times less than the width
// of the area, which is below 2¹⁵.
TileInWindow::TileInWindow(const Window& window, const Places::OfTile& places) {
  const Projection& p = window.camera.projection;
  const auto ends = [&](double scale, double shift, double a, double b, std::uint32_t pixels) {
    const double low = std::min(scale * a, scale * b) + shift;
    const double high = std::max(scale * a, scale * b) + shift;
    const auto pixel = [&](double x) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x), 0.0, pixels - 1.0));
    };
    return std::pair(pixel(low - 0.5), pixel(high + 0.5));
  };
  scale_x = p.fx;
  scale_y = p.fy;
  const auto columns = ends(p.fx, p.cx, places.box.left, places.box.right, window.camera.width);
  const auto rows = ends(p.fy, p.cy, places.box.top, places.box.bottom, window.camera.height);
  error = places.error * std::max(std::abs(scale_x), std::abs(scale_y)) * (1 + 0x1p-40) +
          lens_bounds::window_rounding;
  is_certain = error <= lens_bounds::greatest_error;
  area = {0, window.camera.width - 1, 0, window.camera.height - 1};
  if (is_certain) area = {columns.first, columns.second, rows.first, rows.second};
  shift_x = p.cx - (area.first_column + 0.5);
  shift_y = p.cy - (area.first_row + 0.5);
}

}  // namespace fathom::fast
