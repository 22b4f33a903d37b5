#include "bindings.h"
#include "errors.h"
#include "running.h"

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
  bind_render(core);
  bind_questions(core);
  bind_evaluation(core);
  bind_deep(core);
  bind_depth_formats(core);
  bind_clipping(core);
  bind_validation(core);
}
