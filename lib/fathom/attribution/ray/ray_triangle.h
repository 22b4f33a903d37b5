#pragma once

#include <array>
#include <optional>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/ray/model_ray.h"
#include "fathom/attribution/ray/vector3.h"

namespace fathom::attribution {

/// A triangle at a ray: how a renderer of the model may see it, between near and far of the camera.
/// Nothing where it is certain not to.
///
/// Frame    corners in the moved world of `rays`. The fragment's values are depths.
std::optional<Fragment> ray_on_triangle(const std::array<Vector3, 3>& corners, const Ray& ray,
                                        const ModelRays& rays, const RayModel& model);

}  // namespace fathom::attribution
