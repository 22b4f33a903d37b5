#pragma once

#include <array>
#include <optional>

#include "fathom/camera/camera.h"

namespace fathom::image {

/// In the order of GDAL's geotransform.
using WorldFromImage = std::array<double, 6>;

/// What a GeoTIFF needs of a camera: where in the world a point of the image is, where that does
/// not depend on the depth, because the camera is orthographic and looks straight along the world's
/// z axis, up or down. Other cameras have none.
///
/// Returns  g: the point (u, v), in pixels from the top left corner
///          of the image, v downwards, is x = g[0] + g[1]·u + g[2]·v, y = g[3] + g[4]·u + g[5]·v.
/// Unit     x and y: scene units
/// Exact    whether there is one is decided exactly; each number is the exact one rounded once.
/// Fails    nullopt too where a number is too large for binary64.
std::optional<WorldFromImage> world_from_image(const Camera& camera);

}  // namespace fathom::image
