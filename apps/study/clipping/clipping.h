#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// Where Sutherland–Hodgman is wrong: the bridging edges that it leaves on concave polygons, beside
/// Weiler–Atherton's pieces and the convex decomposition, on named shapes and on random polygons of
/// more and more corners. Clipped exactly; lengths are computed in binary64. And Weiler–Atherton
/// beside CGAL's Boolean set operations: the same answers, and in what time.
/// Defaults: 100 random polygons for each number of corners. near and far mean nothing here.
std::vector<StudyFile> study_clipping(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

}  // namespace fathom::studies
