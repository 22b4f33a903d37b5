#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

/// A scene, a light and a material as two renderers are given them, bit for bit.
namespace fathom::validation {

/// Triangles in the world with a normal at each corner, of unit length but for its rounding.
/// Every number is a binary32 number, so that no renderer rounds it again.
struct LitTriangle {
  std::array<std::array<double, 3>, 3> corners{}, normals{};
};

struct LitScene {
  std::vector<LitTriangle> triangles;
  /// With near and far; every corner lies between them and in the image, so that nothing is cut.
  Camera camera;
  std::array<double, 3> towards_light{};  ///< unit, in the world, in binary64
  pipeline::Material material;            ///< with Phong's highlight, which VTK has; white
};

/// The scene's triangles with the pipeline's normals (primitive_assembly.h), rounded to binary32
/// once, and a light that stands still in the world.
/// Fails    InputError for a camera that is not a perspective one with a rotation, for a corner
///          that is behind the near plane or outside of the image, for one whose normal is 0.
LitScene lit_scene(const Scene& scene, const Camera& camera, const pipeline::Material& material);

/// The same as a scene of one mesh that has the normals.
Scene as_scene(const LitScene& lit);

/// 8-bit colours, rows from the top, black where nothing was drawn: one number for each pixel, as
/// light, material and surfaces are grey.
struct GreyPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> codes;
  std::string version;  ///< of the renderer and its driver
};

}  // namespace fathom::validation
