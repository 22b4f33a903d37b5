#include "fathom/pipeline/geometry/back_face_culling.h"

namespace fathom::pipeline {
namespace {

template <class Real>
Facing facing_of(Real counter_clockwise, FrontFace front_face) {
  if (!(counter_clockwise != 0)) return Facing::edge_on;
  const bool front = (counter_clockwise > 0) == (front_face == FrontFace::counter_clockwise);
  return front ? Facing::front : Facing::back;
}

/// (x₂ − x₁)(y₃ − y₁) − (x₃ − x₁)(y₂ − y₁)
template <class Vertex>
auto determinant(const std::array<Vertex, 3>& v) {
  return (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
}

}  // namespace

template <class Real>
Facing facing_in_window(const std::array<WindowVertex<Real>, 3>& triangle, FrontFace front_face) {
  return facing_of<Real>(-determinant(triangle), front_face);  // y grows down
}

template <class Real>
Facing facing_in_ndc(const std::array<NdcVertex<Real>, 3>& triangle, FrontFace front_face) {
  return facing_of<Real>(determinant(triangle), front_face);
}

template <class Real>
Facing facing_in_world(const std::array<WorldVertex<Real>, 3>& p,
                       const std::array<double, 3>& eye_or_direction, bool perspective,
                       bool mirrored, FrontFace front_face) {
  const std::array<Real, 3> s{p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z};
  const std::array<Real, 3> t{p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
  const std::array<Real, 3> N{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2],
                              s[0] * t[1] - s[1] * t[0]};
  std::array<Real, 3> V{static_cast<Real>(eye_or_direction[0]),
                        static_cast<Real>(eye_or_direction[1]),
                        static_cast<Real>(eye_or_direction[2])};
  if (perspective) V = {V[0] - p[0].x, V[1] - p[0].y, V[2] - p[0].z};
  const Real dot = N[0] * V[0] + N[1] * V[1] + N[2] * V[2];
  return facing_of<Real>(mirrored ? -dot : dot, front_face);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                                                         \
  template Facing facing_in_window(const std::array<WindowVertex<Real>, 3>&, FrontFace); \
  template Facing facing_in_ndc(const std::array<NdcVertex<Real>, 3>&, FrontFace);       \
  template Facing facing_in_world(const std::array<WorldVertex<Real>, 3>&,               \
                                  const std::array<double, 3>&, bool, bool, FrontFace);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
