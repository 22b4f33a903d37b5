#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/scene/streamed_scene.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {

/// A landscape over the unit square: heights within ±greatest_height, a sum of random values at the
/// points of five lattices, blended between them. The same on every machine: sums and products of
/// binary64 numbers, no library function.
inline constexpr double greatest_height = 0.125;

/// The heights along a line of one z, in [0, 1]. Along x they cost little, since what a lattice has
/// between two of its points is kept.
class TerrainHeights {
 public:
  explicit TerrainHeights(double z);
  /// At x in [0, 1]. It does not depend on where one has been before.
  double at(double x);

 private:
  static constexpr std::size_t octaves = 5;
  struct Cell {
    double number = -1;
    double left = 0, step = 0;
  };
  double z_;
  std::array<Cell, octaves> cells_;
};

// Scenes of any number of triangles, which are made as they are drawn (generated_stream.h).

enum class GeneratedKind { terrain, soup };

/// The name by which programs know it.
const char* name_of(GeneratedKind kind);

/// What is asked of a scene that is generated.
struct GeneratedArguments {
  GeneratedKind kind = GeneratedKind::terrain;
  /// At most 2³² − 2.
  std::uint32_t triangles = 1'000'000;
  /// Only for the soup: the edge of the cubes that contain its triangles. The default,
  /// 2 / √triangles, makes soups of any size cover about the same part of the image.
  std::optional<double> edge;
};

/// A scene of one object. Its source is called "generated:terrain:1000000".
/// Fails    UsageError where the edge is not above 0, or above 1; InputError for too many
///          triangles.
StreamedScene generated_scene(const GeneratedArguments& arguments);

/// A camera that looks obliquely down on such a scene, which fills its image: about half of the
/// triangles are outside of it.
Camera camera_of(GeneratedKind kind, const ImageSize& size);

}  // namespace fathom::bench
