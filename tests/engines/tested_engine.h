#pragma once

#include "fathom/render.h"

namespace fathom::checks {

/// The engine that is held to the laws: the program is run once for each, with
/// --engine=reference (the default) or --engine=fast.
Engine tested_engine();

inline Rendered render_and_count(const Scene& scene, const Camera& camera,
                                 RenderOptions options = {}) {
  options.engine = tested_engine();
  return render(scene, camera, options);
}

inline DepthMap render_tested(const Scene& scene, const Camera& camera,
                              const RenderOptions& options = {}) {
  return render_and_count(scene, camera, options).map;
}

}  // namespace fathom::checks
