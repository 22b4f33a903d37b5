#include "fathom/clipping/sutherland_hodgman.h"

#include "fathom/clipping/exact_kernel.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {

template <class Number>
std::vector<Corner2<Number>> sutherland_hodgman(const std::vector<Corner2<Number>>& subject,
                                                const Ring<Number>& convex,
                                                ClipStages<Point2, Number>* trace) {
  const StandardArithmetic standard;
  std::vector<Corner2<Number>> polygon = subject;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Point2<Number>&a = convex[i], &b = convex[(i + 1) % convex.size()];
    // Outside is to the right of the edge.
    polygon = clip_at_boundary(polygon,
                               [&](const Point2<Number>& p) -> Number { return -cross(a, b, p); });
    if (trace != nullptr) trace->push_back(polygon);
  }
  return polygon;
}

template <class Number>
std::vector<Corner3<Number>> sutherland_hodgman(const std::vector<Corner3<Number>>& subject,
                                                const std::vector<Plane<Number>>& planes,
                                                ClipStages<Point3, Number>* trace) {
  const StandardArithmetic standard;
  std::vector<Corner3<Number>> polygon = subject;
  for (const Plane<Number>& plane : planes) {
    check_plane(plane);
    polygon = clip_at_boundary(
        polygon, [&](const Point3<Number>& p) -> Number { return value_at(plane, p); });
    if (trace != nullptr) trace->push_back(polygon);
  }
  return polygon;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                              \
  template std::vector<Corner2<Number>> sutherland_hodgman(                                     \
      const std::vector<Corner2<Number>>&, const Ring<Number>&, ClipStages<Point2, Number>*);   \
  template std::vector<Corner3<Number>> sutherland_hodgman(const std::vector<Corner3<Number>>&, \
                                                           const std::vector<Plane<Number>>&,   \
                                                           ClipStages<Point3, Number>*);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
