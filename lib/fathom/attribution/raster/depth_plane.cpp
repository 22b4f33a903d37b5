#include "fathom/attribution/raster/depth_plane.h"

#include <algorithm>
#include <cmath>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/numeric/standard_arithmetic.h"

// docs/validation.md, "Window depth", derives the bounds in this file.
namespace fathom::attribution {

WindowVertex to_window(const ClipVertex& v, const Camera& camera, const RasterModel& model) {
  constexpr double u = unit_roundoff<float>;
  const double w = v.value[3], rest = std::max(w - v.error[3], 0x1p-1000);
  // A quotient by w: errors of both, a reciprocal of two roundings and a product.
  const auto divided_error = [&](double quotient, double error) {
    return (error + std::abs(quotient) * v.error[3]) / rest + 4 * u * std::abs(quotient);
  };
  const double half_width = camera.width / 2.0, half_height = camera.height / 2.0;
  WindowVertex window{.borders = v.borders};
  window.x = half_width + half_width * (v.value[0] / w);
  window.y = half_height - half_height * (v.value[1] / w);
  window.error_x = own_roundings * (half_width * divided_error(v.value[0] / w, v.error[0]) +
                                    2 * u * (std::abs(window.x) + half_width));
  window.error_y = own_roundings * (half_height * divided_error(v.value[1] / w, v.error[1]) +
                                    2 * u * (std::abs(window.y) + half_height));

  window.from_border = std::max(std::abs(window.y), std::abs(camera.height - window.y));

  const double z = v.value[2] / w;
  // The magnitude of z_ndc/2 if the mapping has it: z is z_ndc/2 + ½.
  const double divided = model.mapping == Mapping::opengl ? z - 0.5 : z;
  window.z = z;
  window.error_z =
      own_roundings * (divided_error(divided, v.error[2]) + 2 * u * (std::abs(z) + 0.5));
  window.q = window.z;
  window.error_q = window.error_z;
  if (model.written && model.written->of_w) {  // a reciprocal of up to two roundings
    window.q = 1 / w;
    window.error_q = own_roundings * (v.error[3] / rest + 3 * u) / w;
  }
  if (!model.written) {
    window.z += model.bias;
    window.error_z += model.bias_error;
  }

  const double snap = std::ldexp(0.5, -model.subpixel_bits);
  window.snapped_x = window.error_x + snap;
  window.snapped_y = window.error_y + snap;
  return window;
}

namespace {

constexpr double u = unit_roundoff<float>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Twice the greatest change of a triangle's area by displaced corners.
double area_error(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const double dx = std::max({a.snapped_x, b.snapped_x, c.snapped_x});
  const double dy = std::max({a.snapped_y, b.snapped_y, c.snapped_y});
  const double width = std::max({a.x, b.x, c.x}) - std::min({a.x, b.x, c.x});
  const double height = std::max({a.y, b.y, c.y}) - std::min({a.y, b.y, c.y});
  return own_roundings * (4 * dx * height + 4 * dy * width + 8 * dx * dy);
}

/// A triangle of three corners of a polygon, as a renderer may split it.
struct Part {
  const WindowVertex *a, *b, *c;
  [[nodiscard]] double area() const { return std::abs(area_of(*a, *b, *c)); }
  [[nodiscard]] bool on_one_border() const { return (a->borders & b->borders & c->borders) != 0; }
};

std::vector<Part> parts_of(const std::vector<WindowVertex>& corners) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        const Part part{&corners[i], &corners[j], &corners[k]};
        if (!part.on_one_border()) parts.push_back(part);
      }
    }
  }
  return parts;
}

/// The value whose plane is sought, and how far it may be off.
struct Named {
  CornerValue value, error;
  bool before_snap;
};

double plane_error(const DepthPlane& plane, const Part& part, const Named& named) {
  const auto& [a, b, c] = part;
  const double area = part.area(), uncertain = area_error(*a, *b, *c);
  if (!(area > 2 * uncertain)) return infinity;
  const double width = std::max({a->x, b->x, c->x}) - std::min({a->x, b->x, c->x});
  const double height = std::max({a->y, b->y, c->y}) - std::min({a->y, b->y, c->y});
  const double g_x = std::abs(plane.g_x), g_y = std::abs(plane.g_y);

  // Corners displaced: Σ λ'ᵢ(z'ᵢ − zᵢ − g·αᵢ), λ' of a sample inside the snapped triangle.
  double displaced = 0, values = 0, offset_x = 0, offset_y = 0;
  for (const WindowVertex* v : {a, b, c}) {
    const double dx = named.before_snap ? v->error_x : v->snapped_x;
    const double dy = named.before_snap ? v->error_y : v->snapped_y;
    displaced = std::max(displaced, v->*named.error + g_x * dx + g_y * dy);
    values = std::max(values, std::abs(v->*named.value));
    offset_x = std::max(offset_x, std::abs(v->x));
    offset_y = std::max(offset_y, v->from_border);
  }
  const double outside = 2 * uncertain / (area - uncertain);  // how far λ' may be negative, in all
  const double spread = 1 + 2 * outside;

  // The plane evaluated in binary32: a gradient, quotients of products over an area; the value at
  // the image's corner, from which rows run up or down; the value at the sample.
  const double at_a = a->*named.value;
  const double range =
      std::abs(b->*named.value - at_a) + std::abs(c->*named.value - at_a) + 4 * displaced;
  const double shape = width * height / (area - uncertain);
  const double slope_x = g_x + 2 * displaced * height / (area - uncertain);
  const double slope_y = g_y + 2 * displaced * width / (area - uncertain);
  const double gradient =
      8 * u * range * shape + (slope_x * width + slope_y * height) * (8 * shape + 4) * u;
  const double evaluated = 8 * u * (values + slope_x * offset_x + slope_y * offset_y);
  return own_roundings * (spread * displaced + spread * gradient + evaluated);
}

}  // namespace

double area_of(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

DepthPlane depth_plane(const std::vector<WindowVertex>& corners, CornerValue value,
                       CornerValue error, bool before_snap) {
  const std::vector<Part> parts = parts_of(corners);
  DepthPlane plane;
  plane.least = infinity;
  plane.greatest = -infinity;
  for (const WindowVertex& c : corners) {
    plane.least = std::min(plane.least, c.*value - c.*error);
    plane.greatest = std::max(plane.greatest, c.*value + c.*error);
  }
  const auto largest = std::max_element(
      parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.area() < q.area(); });
  if (largest == parts.end() || largest->area() == 0) return plane;
  const auto& [a, b, c] = *largest;
  const double area = area_of(*a, *b, *c);
  const double bx = b->x - a->x, by = b->y - a->y, bz = b->*value - a->*value;
  const double cx = c->x - a->x, cy = c->y - a->y, cz = c->*value - a->*value;
  plane.x = a->x;
  plane.y = a->y;
  plane.value = a->*value;
  plane.g_x = (by * cz - cy * bz) / area;
  plane.g_y = (cx * bz - bx * cz) / area;
  plane.is_known = true;
  plane.error = 0;
  const Named named{value, error, before_snap};
  for (const Part& part : parts)
    plane.error = std::max(plane.error, plane_error(plane, part, named));
  return plane;
}

}  // namespace fathom::attribution
