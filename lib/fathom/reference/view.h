#pragma once

#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/lens/preimages.h"
#include "fathom/reference/ray_groups.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::reference {

/// How the samples of an image see: by straight edges, or along rays that a lens bends.
struct View {
  /// `chosen` pixels of the image are looked at, row by row; nullptr: all of them. Both must
  /// outlive the view.
  explicit View(const Camera& the_camera, const std::vector<bool>* chosen = nullptr)
      : camera(the_camera) {
    if (!bends_rays(camera.projection)) return;
    preimages.emplace(camera.projection, *camera.projection.lens);
    groups.emplace(*preimages, camera.width, camera.height, chosen);
  }

  /// A box that contains every pixel looked at whose sample the triangle covers.
  [[nodiscard]] PixelBox box_of(const triangle::ProjectedTriangle& t) const {
    return groups ? groups->box_of(t) : bounding_box(t, camera);
  }

  const Camera& camera;
  /// Where the camera bends rays.
  std::optional<lens::Preimages> preimages;
  std::optional<RayGroups> groups;
};

}  // namespace fathom::reference
