#pragma once

#include <gmp.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "fathom/image/samples.h"
#include "fathom/numeric/ratio.h"

/// Arrays that own their memory, made of what the library returns without copying it; and exact
/// numbers.
namespace fathom::python {

using Shape = std::vector<pybind11::ssize_t>;

template <class T>
pybind11::array array_of(Samples<T>&& samples, Shape shape) {
  auto kept = std::make_unique<Samples<T>>(std::move(samples));
  T* const data = kept->data();
  const pybind11::capsule owner(kept.get(),
                                [](void* memory) { delete static_cast<Samples<T>*>(memory); });
  static_cast<void>(kept.release());
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

template <class T>
pybind11::array array_of(std::vector<T>&& values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* const data = kept->data();
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const pybind11::capsule owner(kept.get(),
                                [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  static_cast<void>(kept.release());
  return pybind11::array_t<T>(Shape{size}, data, owner);
}

/// An array in small pages of memory, whatever it holds. Large arrays of NumPy's ask the system for
/// huge pages, which it may have to make room for first: for a stack of maps that took anything
/// from a tenth to four times the time of rendering, and small pages, which the threads that render
/// share, take about half of it always.
pybind11::array array_in_small_pages(const Shape& shape, const pybind11::dtype& type);

/// What Python's code has made sure of: C order, and this type of elements.
template <class T>
using ContiguousArray = pybind11::array_t<T, pybind11::array::c_style>;

// Exact numbers as Python has them: integers of any size.

pybind11::int_ to_python(mpz_srcptr value);
void from_python(const pybind11::int_& value, mpz_ptr result);

/// (m, e, n, f) of the ratio m·2^e / (n·2^f), not reduced: fractions.Fraction does that.
pybind11::tuple parts_of(const Ratio& ratio);

}  // namespace fathom::python
