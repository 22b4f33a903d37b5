#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/camera/pose.h"
#include "fathom/camera/projection.h"

namespace fathom::view {

struct TilePlace;

/// The planes that an image of depths shows.
struct PlaneHints {
  /// X, Y and Z of the normal of each pixel of the image, in the world.
  std::array<std::span<const float>, 3> normals;
  /// Bends no rays.
  Projection projection;
  Pose world_from_camera;
};

struct ExpectedDepth {
  /// The bits of a binary32 number.
  std::uint32_t word = 0;
  /// Whether a previous neighbour has the same normal.
  bool is_on_known_plane = false;
};

/// The depth that is expected at each pixel of a tile if the previous pixels are known. `words` are
/// the bits of the depths.
///
/// A pixel with the normal n and the ray (u, v, 1) shows the plane n · z (u, v, 1) = h; under an
/// orthographic camera, n · (u, v, z) = h. The expected depth has for h the mean of the left,
/// upper, upper left and upper right neighbours that have the same normal. If there is no such
/// neighbour, two planes meet between the pixels: the expected depth is the mean, of the left and
/// of the upper neighbour, of the depths on the plane of this normal and on the plane of the
/// neighbour's. If neither gives a finite depth above 0, it is the left neighbour's depth, else the
/// upper neighbour's, else 0.
///
/// All is computed in binary64, in the order of web/planes.js, and rounded once to binary32.
std::vector<ExpectedDepth> expected_depths(const std::vector<std::uint32_t>& words,
                                           const PlaneHints& hints, std::uint32_t width,
                                           const TilePlace& tile);

}  // namespace fathom::view
