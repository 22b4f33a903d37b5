#include "fathom/area/plane/edge_rule.h"

#include <algorithm>
#include <utility>

#include "fathom/area/visible_fragments.h"
#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"

namespace fathom::area {
namespace {

double cosine_of(const EdgeOptions& options) {
  if (!(options.crease_angle >= 0 && options.crease_angle <= 180)) {
    throw UsageError("the crease angle: expected degrees from 0 to 180");
  }
  return camera::sine_and_cosine(options.crease_angle).cosine.rounded;
}

/// The normal of a triangle with the length of twice its area, for the corners in their order.
ExactVector3 normal_of(const std::array<WorldPoint, 3>& corners) {
  const auto difference = [](const WorldPoint& p, const WorldPoint& q) {
    return ExactVector3{p.x - q.x, p.y - q.y, p.z - q.z};
  };
  return cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
}

/// Whether d ≤ c·√q, for q > 0.
bool is_at_most(const Dyadic& d, double c, const Dyadic& q) {
  if (d.sign() == Sign::negative && c >= 0) return true;
  if (d.sign() != Sign::negative && c < 0) return false;
  const Dyadic square = d * d, limit = Dyadic(c) * Dyadic(c) * q;
  return c >= 0 ? square <= limit : square >= limit;
}

Ratio value_at(const ExactVector3& form, const ImagePlace& at) {
  return Ratio(form[0]) * at.u + Ratio(form[1]) * at.v + Ratio(form[2]);
}

}  // namespace

EdgeRule::EdgeRule(const TriangleSource& triangles, const PlaneMesh& mesh,
                   const EdgeOptions& options)
    : triangles_(triangles), mesh_(mesh), selection_(options.edges), cosine_(cosine_of(options)) {}

std::uint32_t EdgeRule::object_of(std::uint32_t i) const {
  return triangles_.origin(mesh_.number(i)).object;
}

bool EdgeRule::are_mates(std::uint32_t i, std::uint32_t j) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh_.mate(i, k) == j) return true;
  }
  return false;
}

bool EdgeRule::wants_joined(std::uint32_t i, std::uint32_t j) const {
  switch (selection_) {
    case EdgeSelection::silhouettes:
      return false;
    case EdgeSelection::creases:
      return is_crease(i, j);
    case EdgeSelection::all:
      break;
  }
  return true;
}

bool EdgeRule::leaves_out(std::uint32_t i, std::uint32_t j) const {
  return are_mates(i, j) && object_of(i) == object_of(j) && !wants_joined(i, j);
}

// Both triangles show the side on which the eye is: a normal towards the eye is the mesh's, or its
// opposite, by the sign of the triangle's area on the image.
bool EdgeRule::is_crease(std::uint32_t i, std::uint32_t j) const {
  const std::uint32_t s = mesh_.number(i), t = mesh_.number(j);
  const ExactVector3 m = normal_of(triangles_.world_corners(s)),
                     n = normal_of(triangles_.world_corners(t));
  Dyadic product = dot(m, n);
  if (mesh_.scene().orientation(s) != mesh_.scene().orientation(t)) product = -product;
  return is_at_most(product, cosine_, dot(m, m) * dot(n, n));
}

// The form of in_front() is affine along the edge.
bool EdgeRule::are_equally_deep(std::uint32_t i, std::uint32_t j, const ImagePlace& from,
                                const ImagePlace& to) const {
  const LinearForm form =
      in_front(mesh_.scene().surface(mesh_.number(i)), mesh_.scene().surface(mesh_.number(j)));
  return value_at(form.coefficients(), from).sign() == Sign::zero &&
         value_at(form.coefficients(), to).sign() == Sign::zero;
}

EdgeName EdgeRule::name_of(EdgeSide side) const {
  const CornerIndices& corners = mesh_.corners(side.triangle);
  const bool is_regular = mesh_.is_regular(side.triangle);
  if (!is_regular && side.line >= 3) {
    return {EdgeName::Kind::cut, mesh_.number(side.triangle), side.line};
  }
  // The form of a corner belongs to the edge opposite to it.
  const std::uint32_t first = is_regular ? side.line : (side.line + 1) % 3;
  const auto [low, high] = std::minmax(corners[first], corners[(first + 1) % 3]);
  return {EdgeName::Kind::edge, low, high};
}

std::optional<VisibleEdge> EdgeRule::edge(EdgeSide a, EdgeSide b, ImagePlace from,
                                          ImagePlace to) const {
  // The owner first; numbers of triangles ascend, and `none` is the greatest.
  const bool one_ends = (a.line == EdgeSide::none) != (b.line == EdgeSide::none);
  const bool b_first = one_ends ? a.line == EdgeSide::none : b.triangle < a.triangle;
  if (b_first) std::swap(a, b);
  VisibleEdge edge;
  edge.owner = mesh_.number(a.triangle);
  if (b.triangle != EdgeSide::none) edge.other = mesh_.number(b.triangle);
  if (a.line != EdgeSide::none) {
    edge.name = name_of(a);
  } else {
    edge.name = {EdgeName::Kind::crossing, edge.owner, edge.other};
  }
  if (b.line != EdgeSide::none && object_of(a.triangle) == object_of(b.triangle)) {
    edge.joined =
        are_mates(a.triangle, b.triangle) || are_equally_deep(a.triangle, b.triangle, from, to);
  }
  if (edge.joined && !wants_joined(a.triangle, b.triangle)) return std::nullopt;
  edge.from = std::move(from);
  edge.to = std::move(to);
  return edge;
}

VisibleEdge EdgeRule::whole_edge(std::uint32_t i, std::uint32_t k) const {
  const auto place = [&](std::uint32_t corner) {
    const ExactVector3 p = mesh_.scene().homogeneous(mesh_.corners(i)[corner % 3]);
    return ImagePlace{{p[0], p[2]}, {p[1], p[2]}};
  };
  const std::uint32_t mate = mesh_.mate(i, k);
  VisibleEdge edge;
  edge.name = name_of({i, k});
  edge.owner = mesh_.number(std::min(i, mate));
  edge.other = mesh_.number(std::max(i, mate));
  edge.joined = object_of(i) == object_of(mate);
  edge.from = place(k);
  edge.to = place(k + 1);
  return edge;
}

}  // namespace fathom::area
