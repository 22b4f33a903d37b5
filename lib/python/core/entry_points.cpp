#include "entry_points.h"

#include <optional>

namespace py = pybind11;

namespace fathom::python {
namespace {

class StandardArithmeticContext {
 public:
  void enter() { kept_.emplace(); }
  void exit(const py::args&) { kept_.reset(); }

 private:
  std::optional<StandardArithmetic> kept_;
};

}  // namespace

void bind_standard_arithmetic(py::module_& core) {
  py::class_<StandardArithmeticContext>(core, "standard_arithmetic")
      .def(py::init<>())
      .def("__enter__", &StandardArithmeticContext::enter)
      .def("__exit__", &StandardArithmeticContext::exit);
}

}  // namespace fathom::python
