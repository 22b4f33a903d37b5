#include "fathom/triangle/projected_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fathom::triangle {

bool is_in_range(const Ratio& depth, const Camera& camera) {
  if (depth.sign() != Sign::positive || depth < Ratio(Dyadic(camera.near))) return false;
  return camera.far == std::numeric_limits<double>::infinity() ||
         !(Ratio(Dyadic(camera.far)) < depth);
}

namespace {

ExactVector3 operator*(Sign sign, ExactVector3 v) {
  if (sign == Sign::negative) {
    for (Dyadic& component : v) component = -component;
  }
  return v;
}

/// Left: l_u > 0. Top: l_u = 0 and l_v > 0. `l` is the edge function with its inside positive.
bool is_left_or_top(const ExactVector3& l) {
  if (l[0].sign() != Sign::zero) return l[0].sign() == Sign::positive;
  return l[1].sign() == Sign::positive;
}

/// sign·(b × c), sign·(c × a) and sign·(a × b).
std::array<LinearForm, 3> edges_of(const std::array<ExactVector3, 3>& corners, Sign sign) {
  std::array<LinearForm, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    edges[i] = LinearForm(sign * cross(corners[(i + 1) % 3], corners[(i + 2) % 3]));
  }
  return edges;
}

void set_forms_on_image(ProjectedTriangle& t, const Projection& projection, TierCounts& counts) {
  std::array<ExactVector3, 3> image;  // a, b, c
  for (std::size_t i = 0; i < 3; ++i) {
    const HomogeneousImagePoint p = to_image(projection, t.camera[i]);
    image[i] = {p.U, p.V, p.W};
  }
  t.orientation = sign_of_determinant(image[0], image[1], image[2], counts);
  if (t.orientation == Sign::zero) return;
  t.edges = edges_of(image, t.orientation);
  for (std::size_t i = 0; i < 3; ++i) {
    t.left_or_top[i] = is_left_or_top(t.edges[i].coefficients());
  }
  const auto& [A, B, C] = t.camera;
  t.depth_numerator = interpolated_form(t, {A.z, B.z, C.z});
  t.weight = interpolated_form(t, {1.0, 1.0, 1.0});
}

/// Whether a sample on the edge counts where rays are bent: its direction is moved by an
/// infinitesimal step to the right in the image, by a smaller step downwards, and by a smaller one
/// still forwards. `l` is the edge function with its inside positive.
bool moves_inside(const ExactVector3& l, const Projection& projection) {
  if (l[0].sign() != Sign::zero) return l[0].sign() == sign_of(projection.fx < 0 ? -1 : 1);
  if (l[1].sign() != Sign::zero) return l[1].sign() == sign_of(projection.fy < 0 ? -1 : 1);
  return l[2].sign() == Sign::positive;
}

void set_forms_on_rays(ProjectedTriangle& t, const Projection& projection, TierCounts& counts) {
  std::array<ExactVector3, 3> corners;  // a, b, c
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {t.camera[i].x, t.camera[i].y, t.camera[i].z};
  const Sign side = sign_of_determinant(corners[0], corners[1], corners[2], counts);
  t.orientation = is_mirrored(projection) ? -side : side;
  if (side == Sign::zero) return;
  t.edges = edges_of(corners, side);
  for (std::size_t i = 0; i < 3; ++i) {
    t.left_or_top[i] = moves_inside(t.edges[i].coefficients(), projection);
  }
  t.weight = interpolated_form(t, {1.0, 1.0, 1.0});
  t.volume = dot(corners[0], t.edges[0].coefficients());
  t.depth_numerator = LinearForm({0.0, 0.0, t.volume});
}

/// The integers in [0, count − 1] near an interval of the image, one more on each side, so that
/// roundings of the ends do no harm. Leaves `first` and `last` alone if there is none.
void near(const Interval& range, std::uint32_t count, std::uint32_t& first, std::uint32_t& last) {
  const double greatest = static_cast<double>(count) - 1;
  const double low = std::floor(range.lower) - 1;
  const double high = std::ceil(range.upper) + 1;
  if (low > greatest || high < 0) return;
  first = static_cast<std::uint32_t>(std::clamp(low, 0.0, greatest));
  last = static_cast<std::uint32_t>(std::clamp(high, 0.0, greatest));
}

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

}  // namespace

std::array<WorldPoint, 3> world_corners(const Object& object, const Mesh& mesh,
                                        std::uint32_t triangle) {
  std::array<WorldPoint, 3> world;
  for (std::size_t i = 0; i < 3; ++i) {
    world[i] = to_world(object, mesh.vertices[mesh.triangles[triangle][i]]);
  }
  return world;
}

ProjectedTriangle project(const std::array<WorldPoint, 3>& world, std::uint32_t number,
                          const Camera& camera, TierCounts& counts) {
  ProjectedTriangle t;
  t.number = number;
  t.world = world;
  for (std::size_t i = 0; i < 3; ++i) t.camera[i] = to_camera(camera.world_to_camera, world[i]);
  if (bends_rays(camera.projection)) {
    set_forms_on_rays(t, camera.projection, counts);
  } else {
    set_forms_on_image(t, camera.projection, counts);
  }
  return t;
}

bool covers(const ProjectedTriangle& triangle, const Sample& s, TierCounts& counts) {
  if (triangle.orientation == Sign::zero) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Sign side = s.sign_of(triangle.edges[i], counts);
    if (side == Sign::negative) return false;
    if (side == Sign::zero && !triangle.left_or_top[i]) return false;
  }
  return true;
}

bool is_kept(const ProjectedTriangle& triangle, Cull cull) {
  switch (cull) {
    case Cull::back:
      return triangle.orientation == Sign::negative;
    case Cull::front:
      return triangle.orientation == Sign::positive;
    case Cull::none:
      break;
  }
  return true;
}

LinearForm interpolated_form(const ProjectedTriangle& triangle,
                             const std::array<Dyadic, 3>& corner_values) {
  ExactVector3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactVector3& edge = triangle.edges[i].coefficients();
    for (std::size_t k = 0; k < 3; ++k) sum[k] += corner_values[i] * edge[k];
  }
  return LinearForm(sum);
}

Ratio interpolate(const ProjectedTriangle& triangle, const ImagePoint& s,
                  const std::array<Dyadic, 3>& corner_values) {
  Dyadic numerator, denominator;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic e = triangle.edges[i].at(s.u, s.v);
    numerator += e * corner_values[i];
    denominator += e;
  }
  return {numerator, denominator};
}

Ratio depth_at(const ProjectedTriangle& triangle, const ImagePoint& s) {
  return {triangle.depth_numerator.at(s.u, s.v), triangle.weight.at(s.u, s.v)};
}

PixelBox bounding_box(const ProjectedTriangle& triangle, const Camera& camera) {
  PixelBox box;
  std::array<HomogeneousImagePoint, 3> corners;
  int in_front = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = to_image(camera.projection, triangle.camera[i]);
    if (corners[i].W.sign() == Sign::positive) ++in_front;
  }
  if (in_front == 0) return box;
  if (in_front < 3) return {0, camera.width - 1, 0, camera.height - 1};
  std::array<Interval, 3> u, v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval W = enclose(corners[i].W);
    u[i] = quotient(enclose(corners[i].U), W);
    v[i] = quotient(enclose(corners[i].V), W);
  }
  near(hull(hull(u[0], u[1]), u[2]), camera.width, box.first_column, box.last_column);
  near(hull(hull(v[0], v[1]), v[2]), camera.height, box.first_row, box.last_row);
  return box;
}

}  // namespace fathom::triangle
