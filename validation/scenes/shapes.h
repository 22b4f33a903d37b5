#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// The meshes that engines and peers are timed on, in the world, scene units, and a camera that
/// looks at them. All are made from fixed seeds; coordinates are binary64 numbers, not necessarily
/// representable in binary32.
namespace fathom::bench {

/// A scene of one object per mesh, placed as it is.
Scene as_scene(std::vector<Mesh> meshes, const std::string& name);

/// A sphere about `centre`: an octahedron subdivided into rings, 8·n² triangles of about the same
/// size, counter-clockwise from outside, with n >= 1 chosen so that their number is nearest to
/// `triangles`.
Mesh sphere(std::uint64_t triangles, const std::array<double, 3>& centre = {0, 0, 0},
            double radius = 1);

/// `count` random triangles in front of `camera` (perspective), between depths 2 and 6, so large
/// that on average `depth_complexity` of them cover each pixel.
Mesh soup(std::uint32_t count, double depth_complexity, const Camera& camera);

/// `count` triangles, each of which covers the whole image of `camera` (perspective) and reaches
/// far beyond it, tilted so that each is nearest somewhere.
Mesh few_large(std::uint32_t count, const Camera& camera);

/// columns × rows quads of two triangles each. The first quad's first corner is at (left, top);
/// corners are one `step` apart in x and y; z is a smooth wave about 4.
Mesh grid(std::uint32_t columns, std::uint32_t rows, double left, double top, double step);

/// A closed room, the box [−4, 4] × [−1.5, 1.5] × [−3, 3] (y up): walls of `cells` × `cells` quads
/// each, floor and ceiling of two triangles each, facing inwards, and two spheres of 20 thousand
/// triangles in it.
std::vector<Mesh> room(std::uint32_t cells);

/// In pixels.
struct ImageSize {
  std::uint32_t width, height;
  [[nodiscard]] std::uint32_t least() const { return std::min(width, height); }
};

/// At the origin, looking along +z, with square pixels and the principal point in the middle of the
/// image; the focal length is in heights of the image.
Camera simple_camera(const ImageSize& size, double focal = 1.2);

}  // namespace fathom::bench
