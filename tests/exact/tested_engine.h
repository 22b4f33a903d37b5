#pragma once

#include "fathom/render.h"

namespace fathom::testing {

/// The tests that include this are built once for each engine.
#ifdef FATHOM_TEST_THE_FAST_ENGINE
inline constexpr Engine tested_engine = Engine::fast;
#else
inline constexpr Engine tested_engine = Engine::reference;
#endif

inline DepthMap render_tested(const Scene& scene, const Camera& camera,
                              RenderOptions options = {}) {
  options.engine = tested_engine;
  return render(scene, camera, options);
}

}  // namespace fathom::testing
