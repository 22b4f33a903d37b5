#include <pybind11/stl.h>

#include "bindings.h"
#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/failures/errors.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using clipping::Point2;
using clipping::Polygon;
using clipping::Rational;
using clipping::Ring;
using clipping::Rings;

/// Of (numerator, denominator), which Python has reduced.
Rational rational_of(const py::handle& number) {
  const auto pair = py::reinterpret_borrow<py::tuple>(number);
  Rational rational;
  from_python(pair[0].cast<py::int_>(), mpq_numref(rational.mpq()));
  from_python(pair[1].cast<py::int_>(), mpq_denref(rational.mpq()));
  return rational;
}

py::tuple to_python(const Rational& number) {
  return py::make_tuple(python::to_python(mpq_numref(number.mpq())),
                        python::to_python(mpq_denref(number.mpq())));
}

Rings<Rational> rings_of(const py::list& list) {
  Rings<Rational> rings;
  for (const py::handle ring : list) {
    rings.emplace_back();
    for (const py::handle point : py::reinterpret_borrow<py::list>(ring)) {
      const auto pair = py::reinterpret_borrow<py::tuple>(point);
      rings.back().push_back({rational_of(pair[0]), rational_of(pair[1])});
    }
  }
  return rings;
}

py::list to_python(const Ring<Rational>& ring) {
  py::list list;
  for (const Point2<Rational>& point : ring)
    list.append(py::make_tuple(to_python(point.x), to_python(point.y)));
  return list;
}

py::list to_python(const std::vector<Polygon<Rational>>& polygons) {
  py::list list;
  for (const Polygon<Rational>& polygon : polygons) {
    py::list holes;
    for (const Ring<Rational>& hole : polygon.holes) holes.append(to_python(hole));
    list.append(py::make_tuple(to_python(polygon.outline), holes));
  }
  return list;
}

py::list clip(const py::list& subject, const py::list& window, const std::string& operation_name,
              bool by_cgal) {
  const Rings<Rational> a = rings_of(subject), b = rings_of(window);
  const auto operation = operation_name == "union"        ? clipping::SetOperation::join
                         : operation_name == "difference" ? clipping::SetOperation::difference
                                                          : clipping::SetOperation::intersection;
  return to_python(run([&](const auto&) {
    return by_cgal ? clipping::boolean_by_cgal(a, b, operation)
                   : clipping::weiler_atherton(a, b, operation);
  }));
}

}  // namespace

void bind_clipping(Module& core) {
  core.def("clip", &clip);
}

}  // namespace fathom::python
