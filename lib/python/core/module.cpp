#include <exception>
#include <new>
#include <optional>

#include "bindings.h"
#include "entry_points.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/failure_kind.h"
#include "running.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// Borrowed: the module, which is never unloaded, holds them.
PyObject *usage_error, *input_error, *output_error;

PyObject* make_error(py::module_& core, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full = std::string("fathom.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  core.attr(name) = py::reinterpret_steal<py::object>(type);
  return type;
}

/// Names of files that are not UTF-8 stand in messages, as Python writes them.
void set_error(PyObject* type, const std::exception& error) {
  const std::string text = error.what();
  PyObject* message =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
  if (message == nullptr) return;
  PyErr_SetObject(type, message);
  Py_DECREF(message);
}

PyObject* type_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::usage:
      return usage_error;
    case FailureKind::output:
      return output_error;
    default:
      return input_error;
  }
}

/// Other exceptions become those of pybind11.
// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 has it so
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    set_error(type_of(kind_of(error)), error);
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, "fathom: there is not enough memory");
  }
}

/// Makes Error, UsageError, InputError and OutputError, and has ours become them.
void bind_errors(py::module_& core) {
  PyObject* const base = make_error(core, "Error", "An error of fathom; its message is one line.",
                                    py::make_tuple(py::handle(PyExc_Exception)));
  const auto under = [&](PyObject* builtin) {
    return py::make_tuple(py::handle(base), py::handle(builtin));
  };
  usage_error = make_error(core, "UsageError", "A request that makes no sense; also a ValueError.",
                           under(PyExc_ValueError));
  input_error = make_error(core, "InputError",
                           "A file, scene, camera or map that cannot be used; also a ValueError.",
                           under(PyExc_ValueError));
  output_error = make_error(core, "OutputError",
                            "An output that cannot be written or does not fit its format; also an "
                            "OSError.",
                            under(PyExc_OSError));
  py::register_exception_translator(&translate);
}

class StandardArithmeticContext {
 public:
  void enter() { kept_.emplace(); }
  void exit(const py::args&) { kept_.reset(); }

 private:
  std::optional<StandardArithmetic> kept_;
};

/// Defines the context `standard_arithmetic()`, for lines of the package that compute in Python.
void bind_standard_arithmetic(py::module_& core) {
  py::class_<StandardArithmeticContext>(core, "standard_arithmetic")
      .def(py::init<>())
      .def("__enter__", &StandardArithmeticContext::enter)
      .def("__exit__", &StandardArithmeticContext::exit);
}

}  // namespace
}  // namespace fathom::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the modules of fathom call: see those.";
  module.attr("version") = FATHOM_VERSION;
  using namespace fathom::python;
  bind_errors(module);
  bind_standard_arithmetic(module);
  Module core(module);
  end_work_at_exit(core);
  bind_camera(core);
  bind_scene(core);
  bind_maps(core);
  bind_comparison(core);
  bind_pictures(core);
  bind_render(core);
  bind_questions(core);
  bind_evaluation(core);
  bind_rays(core);
  bind_areas(core);
  bind_deep(core);
  bind_depth_formats(core);
  bind_clipping(core);
  bind_validation(core);
}
