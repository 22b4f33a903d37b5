#pragma once

#include <pybind11/pybind11.h>

namespace fathom::python {

/// Makes Error, UsageError, InputError and OutputError, and has ours become them.
void bind_errors(pybind11::module_& core);

}  // namespace fathom::python
