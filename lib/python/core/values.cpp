#include "values.h"

#include <new>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace py = pybind11;

namespace fathom::python {

#ifdef __linux__

namespace {

struct Mapping {
  explicit Mapping(std::size_t length) : bytes(length) {
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    madvise(memory, bytes, MADV_NOHUGEPAGE);  // a hint
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { munmap(memory, bytes); }

  void* memory = nullptr;
  std::size_t bytes;
};

}  // namespace

py::array array_in_small_pages(const Shape& shape, const py::dtype& type) {
  auto bytes = static_cast<std::size_t>(type.itemsize());
  for (const py::ssize_t side : shape) bytes *= static_cast<std::size_t>(side);
  if (bytes == 0) return py::array(type, shape);
  auto kept = std::make_unique<Mapping>(bytes);
  void* const memory = kept->memory;
  const py::capsule owner(kept.get(), [](void* mapping) { delete static_cast<Mapping*>(mapping); });
  static_cast<void>(kept.release());
  return py::array(type, shape, memory, owner);
}

#else

py::array array_in_small_pages(const Shape& shape, const py::dtype& type) {
  return py::array(type, shape);
}

#endif

}  // namespace fathom::python

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
