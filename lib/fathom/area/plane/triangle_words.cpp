#include "fathom/area/plane/triangle_words.h"

namespace fathom::area {

WordVector in_words(const ExactVector3& v) {
  return {fathom::in_words(v[0]), fathom::in_words(v[1]), fathom::in_words(v[2])};
}

WordVector cross(const WordVector& a, const WordVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Words dot(const WordVector& a, const WordVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static WordVector place_of(const ProjectedScene& scene, std::uint32_t vertex,
                           const PlanePart& part) {
  const auto [U, V, W] = in_words(scene.homogeneous(vertex));
  return {U - Words{part.left, 0} * W, V - Words{part.top, 0} * W, W};
}

std::array<WordVector, 3> edges_in_words(const PlaneMesh& mesh, std::uint32_t triangle,
                                         const PlanePart& part) {
  const CornerIndices& corners = mesh.corners(triangle);
  const WordVector a = place_of(mesh.scene(), corners[0], part),
                   b = place_of(mesh.scene(), corners[1], part),
                   c = place_of(mesh.scene(), corners[2], part);
  return {cross(b, c), cross(c, a), cross(a, b)};
}

// As ProjectedScene::surface(): w is the sum of the edge functions, and n the sum of the edge
// functions times the depths of the opposite corners. The depth of a perspective camera is W, so
// that n is the determinant of the corners in homogeneous coordinates. For an orthographic camera
// W = 1, and w is this determinant, the sum of the edge functions' constants.
DepthPlane::DepthPlane(const PlaneMesh& mesh, std::uint32_t triangle, const PlanePart& part)
    : is_perspective_(mesh.scene().has_perspective()) {
  const ProjectedScene& scene = mesh.scene();
  const std::array<WordVector, 3> edges = edges_in_words(mesh, triangle, part);
  affine_.fill({0.0, 0});
  constant_ = {0.0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Words depth = fathom::in_words(scene.exact_depth(mesh.corners(triangle)[i]));
    const Words factor = is_perspective_ ? Words{1.0, 0} : depth;
    for (std::size_t k = 0; k < 3; ++k) affine_[k] = affine_[k] + factor * edges[i][k];
    constant_ = constant_ + (is_perspective_ ? depth * edges[i][2] : edges[i][2]);
  }
}

// n_t·w_s − n_s·w_t, as in_front().
DepthPlane::Comparison::Comparison(const DepthPlane& s, const DepthPlane& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Words difference = s.constant_ * t.affine_[k] - t.constant_ * s.affine_[k];
    form_[k] = leading_word(s.is_perspective_ ? -difference : difference);
  }
}

Sign DepthPlane::Comparison::sign_at(const CertifiedPoint& place) const {
  return certain_sign(form_[0] * place.u + form_[1] * place.v + form_[2]);
}

}  // namespace fathom::area
