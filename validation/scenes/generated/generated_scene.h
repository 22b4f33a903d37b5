#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/scene/streamed_scene.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {

/// A landscape over the unit square. Heights are within ±greatest_height: sums of random values at
/// the points of five lattices, interpolated between the points. They are the same on every
/// machine, because they use only sums and products of binary64 numbers and no library function.
inline constexpr double greatest_height = 0.125;

/// The heights along a line of constant z, in [0, 1]. Walking along x costs little, because the
/// values between two points of a lattice are kept.
class TerrainHeights {
 public:
  explicit TerrainHeights(double z);
  /// The height at x in [0, 1]. It does not depend on earlier calls.
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

// Scenes with any number of triangles, which are generated while they are drawn
// (generated_stream.h).

enum class GeneratedKind { terrain, soup };

/// The name by which programs know it.
const char* name_of(GeneratedKind kind);

/// The options of a generated scene.
struct GeneratedArguments {
  GeneratedKind kind = GeneratedKind::terrain;
  /// At most 2³² − 2.
  std::uint32_t triangles = 1'000'000;
  /// Only for the soup: the edge of the cubes that contain its triangles. The default,
  /// 2 / √triangles, makes soups of any size cover about the same part of the image.
  std::optional<double> edge;
};

/// A scene of one object. Its source is called "generated:terrain:1000000".
/// Fails    UsageError if the edge is not above 0, or above 1; InputError for too many triangles.
StreamedScene generated_scene(const GeneratedArguments& arguments);

/// A camera that looks obliquely down on such a scene. The scene fills the image, and about half of
/// the triangles are outside it.
Camera camera_of(GeneratedKind kind, const ImageSize& size);

}  // namespace fathom::bench
