#include "exact.h"

#include <string>

namespace py = pybind11;

namespace fathom::python {

// By way of hexadecimal digits, which take linear time, and which Python does not limit in number
// as it does decimal ones.
py::int_ to_python(mpz_srcptr value) {
  std::string digits(mpz_sizeinbase(value, 16) + 2, '\0');
  mpz_get_str(digits.data(), 16, value);
  PyObject* const number = PyLong_FromString(digits.c_str(), nullptr, 16);
  if (!number) throw py::error_already_set();
  return py::reinterpret_steal<py::int_>(number);
}

void from_python(const py::int_& value, mpz_ptr result) {
  const auto digits = py::reinterpret_steal<py::str>(PyNumber_ToBase(value.ptr(), 16));
  if (!digits) throw py::error_already_set();
  // "0x1f" or "-0x1f", which GMP reads by itself
  mpz_set_str(result, std::string(digits).c_str(), 0);
}

py::tuple parts_of(const Ratio& ratio) {
  return py::make_tuple(to_python(ratio.numerator.significand()), ratio.numerator.exponent(),
                        to_python(ratio.denominator.significand()), ratio.denominator.exponent());
}

}  // namespace fathom::python
