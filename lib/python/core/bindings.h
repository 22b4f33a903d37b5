#pragma once

#include <pybind11/pybind11.h>

/// One function for each file of bindings. What they bind is for the modules of the package alone,
/// which check arguments, keep units and shapes, and carry the documentation.
namespace fathom::python {

void bind_camera(pybind11::module_& core);
void bind_scene(pybind11::module_& core);
void bind_maps(pybind11::module_& core);
void bind_render(pybind11::module_& core);
void bind_questions(pybind11::module_& core);
void bind_evaluation(pybind11::module_& core);
void bind_deep(pybind11::module_& core);
void bind_depth_formats(pybind11::module_& core);
void bind_clipping(pybind11::module_& core);
void bind_validation(pybind11::module_& core);

}  // namespace fathom::python
