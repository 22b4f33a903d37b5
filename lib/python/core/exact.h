#pragma once

#include <gmp.h>
#include <pybind11/pybind11.h>

#include "fathom/numeric/ratio.h"

/// Exact numbers as Python has them: integers of any size.
namespace fathom::python {

pybind11::int_ to_python(mpz_srcptr value);
void from_python(const pybind11::int_& value, mpz_ptr result);

/// (m, e, n, f) of the ratio m·2^e / (n·2^f), not reduced: fractions.Fraction does that.
pybind11::tuple parts_of(const Ratio& ratio);

}  // namespace fathom::python
