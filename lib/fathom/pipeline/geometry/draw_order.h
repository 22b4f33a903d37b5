#pragma once

#include "fathom/pipeline/geometry/window_triangle.h"

namespace fathom::pipeline {

/// Puts triangles into the order that the options ask for. By depth means by that of the mean of a
/// triangle's three corners along the view, equal ones as in the file: right for small triangles
/// that do not penetrate each other, and only for these (painters_algorithm.h is right for more).
template <class Real>
void put_into_draw_order(std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options);

}  // namespace fathom::pipeline
