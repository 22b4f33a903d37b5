#pragma once

#include <optional>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// Depths, in scene units.
struct ClipPlanes {
  double near = 0, far = 0;
};

/// Near and far between which a map's window depths were stored, where the camera has others.
///
/// Source   a window depth of n bits is the code k of 1/D = 1/near − k·(1/near − 1/far)/(2ⁿ − 1),
///          so the inverse depths of a map lie on a lattice. Its step and its phase give near and
///          far, if near has at most three digits and far is the camera's or has at most two.
/// Exact    a depth fits if 1/D is within four roundings to binary32 of a code. All depths have to,
///          the codes have to be at least 16 times as far apart, and so many have to fit that
///          chance gives a map such a lattice at most once in 2²⁰.
/// Needs    a perspective camera and a model of OpenGL's window depths in 16, 24 or 32 bits; else
///          nothing.
std::optional<ClipPlanes> stored_planes(const Camera& camera, const OtherMap& other,
                                        const RendererModel& model);

}  // namespace fathom::attribution
