#pragma once

#include "entry_points.h"

/// One function for each file of bindings. What they bind is for the modules of the package alone,
/// which check arguments, keep units and shapes, and carry the documentation.
namespace fathom::python {

void bind_camera(Module& core);
void bind_scene(Module& core);
void bind_maps(Module& core);
void bind_comparison(Module& core);
void bind_pictures(Module& core);
void bind_render(Module& core);
void bind_questions(Module& core);
void bind_evaluation(Module& core);
void bind_rays(Module& core);
void bind_areas(Module& core);
void bind_deep(Module& core);
void bind_depth_formats(Module& core);
void bind_clipping(Module& core);
void bind_validation(Module& core);

}  // namespace fathom::python
