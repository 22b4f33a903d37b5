#include "fathom/clipping/boxes.h"

#include <CGAL/Interval_nt.h>
#include <CGAL/box_intersection_d.h>

#include "fathom/numeric/certified.h"

namespace fathom::clipping {
namespace {

/// For use while a Protector lives: the processor then rounds upwards.
using FilterInterval = CGAL::Interval_nt<false>;

struct NumberedBox : CGAL::Box_intersection_d::Box_d<double, 2> {
  NumberedBox(const Box& box, std::size_t place)
      : Box_d(CGAL::Bbox_2(box.x.least, box.y.least, box.x.greatest, box.y.greatest)),
        number(place) {}
  std::size_t number;
};

std::vector<NumberedBox> numbered_boxes(const std::vector<Box>& boxes) {
  std::vector<NumberedBox> numbered;
  numbered.reserve(boxes.size());
  for (const Box& box : boxes) numbered.emplace_back(box, numbered.size());
  return numbered;
}

}  // namespace

Bounds bounds_of(const Rational& x) {
  const auto [least, greatest] = CGAL::to_interval(x);
  return {least, greatest};
}

std::optional<int> settled_sign_of_cross(const Box& a, const Box& b, const Box& c) {
  if (a.is_exact() && b.is_exact() && c.is_exact())
    return static_cast<int>(
        orientation({a.x.least, a.y.least}, {b.x.least, b.y.least}, {c.x.least, c.y.least}));
  // Below that no product overflows, so that ∞ − ∞ and 0·∞ do not arise.
  constexpr double greatest = 0x1p500;
  for (const Box* box : {&a, &b, &c})
    for (const Bounds& bounds : {box->x, box->y})
      if (!(bounds.least > -greatest && bounds.greatest < greatest)) return std::nullopt;
  const FilterInterval::Protector upwards;
  const auto interval = [](const Bounds& bounds) {
    return FilterInterval(bounds.least, bounds.greatest);
  };
  const FilterInterval ax = interval(a.x), ay = interval(a.y);
  const FilterInterval left = (interval(b.x) - ax) * (interval(c.y) - ay);
  const FilterInterval right = (interval(b.y) - ay) * (interval(c.x) - ax);
  if (left.inf() > right.sup()) return 1;
  if (left.sup() < right.inf()) return -1;
  return std::nullopt;
}

void visit_meeting_boxes(const std::vector<Box>& some, const std::vector<Box>& others,
                         const std::function<void(std::size_t, std::size_t)>& visit) {
  auto numbered = numbered_boxes(some), numbered_others = numbered_boxes(others);
  CGAL::box_intersection_d(
      numbered.begin(), numbered.end(), numbered_others.begin(), numbered_others.end(),
      [&](const NumberedBox& a, const NumberedBox& b) { visit(a.number, b.number); });
}

}  // namespace fathom::clipping
