#include "validation/scenes/generated/generated_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "validation/scenes/generated/generated_stream.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

struct HeightOctave {
  /// Cells of the lattice along a side of the square.
  double cells;
  double height;
};

/// The sum of the heights leaves room below greatest_height for what rounding may add.
constexpr std::array<HeightOctave, 5> all_octaves{
    {{5, 0.06}, {11, 0.03}, {23, 0.015}, {47, 0.0075}, {97, 0.004}}};

double smooth(double t) {
  return t * t * (3 - 2 * t);
}

/// In [−1, 1).
double height_at(std::size_t octave, std::uint64_t x, std::uint64_t z) {
  const std::uint64_t bits = scattered((std::uint64_t{octave} << 32) + (x << 16) + z);
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

/// The part of a number that is at least 0 before the point.
double whole(double value) {
  return static_cast<double>(static_cast<std::int32_t>(value));
}

}  // namespace

TerrainHeights::TerrainHeights(double z) : z_(z) {}

double TerrainHeights::at(double x) {
  static_assert(all_octaves.size() == octaves);
  double height = 0;
  for (std::size_t k = 0; k < octaves; ++k) {
    const HeightOctave& octave = all_octaves[k];
    Cell& cell = cells_[k];
    const double position = x * octave.cells, number = whole(position);
    if (cell.number != number) {
      const double along_z = z_ * octave.cells, row = whole(along_z), t = smooth(along_z - row);
      const auto at_side = [&](double column) {
        const auto i = static_cast<std::uint64_t>(column), j = static_cast<std::uint64_t>(row);
        const double far = height_at(k, i, j), near = height_at(k, i, j + 1);
        return octave.height * (far + (near - far) * t);
      };
      const double left = at_side(number);
      cell = {number, left, at_side(number + 1) - left};
    }
    height += cell.left + cell.step * smooth(position - number);
  }
  return height;
}

namespace {

std::unique_ptr<TriangleStream> stream_of(const GeneratedArguments& arguments) {
  if (arguments.kind == GeneratedKind::terrain)
    return std::make_unique<TerrainStream>(arguments.triangles);
  const double usual = 2 / std::sqrt(std::max(arguments.triangles, 4U));
  const double edge = arguments.edge.value_or(usual);
  if (!(edge > 0 && edge <= 1)) throw UsageError("the edge of a soup is above 0, and at most 1");
  return std::make_unique<SoupStream>(arguments.triangles, edge);
}

constexpr View oblique{.azimuth = 0, .elevation = 45};

/// How far an image reaches to each side of its middle, at distance 1.
struct Reach {
  double right, up;
};

Reach reach_of(const LensChoice& lens) {
  const double up = std::tan(lens.vertical_fov * (std::acos(-1.0) / 360));
  return {up * lens.width / lens.height, up};
}

/// The whole image shows the plane of the lowest points within the square: what is in front of that
/// is landscape. The eye stands on the side of the greatest z, above the square.
Camera camera_of_terrain(const LensChoice& lens) {
  const Reach reach = reach_of(lens);
  // From an eye at distance 1, at 45°: where the upper corners of the image lie in that plane.
  const double along_ray = 1 / (1 - reach.up);
  const double right = reach.right * along_ray;
  const double back = std::sqrt(0.5) * (along_ray * (1 + reach.up) - 1);
  return look_from(oblique, {0.5, -greatest_height, 0.5}, 0.5 / std::max(right, back), lens);
}

/// From so near that the image ends within the cube, where it passes through its middle.
Camera camera_of_soup(const LensChoice& lens) {
  const Reach reach = reach_of(lens);
  return look_from(oblique, {0.5, 0.5, 0.5}, 0.4 / std::max(reach.right, reach.up), lens);
}

}  // namespace

const char* name_of(GeneratedKind kind) {
  return kind == GeneratedKind::terrain ? "terrain" : "soup";
}

StreamedScene generated_scene(const GeneratedArguments& arguments) {
  const std::string name = name_of(arguments.kind);
  const std::string path = "generated:" + name + ":" + std::to_string(arguments.triangles);
  mesh::expect_countable(arguments.triangles, "triangles", path);
  StreamedScene scene;
  scene.streams.push_back(stream_of(arguments));
  scene.streams.back()->source.path = path;
  scene.sources.push_back(scene.streams.back()->source);
  Object object;
  object.name = name;
  scene.objects.push_back(object);
  return scene;
}

Camera camera_of(GeneratedKind kind, const ImageSize& size) {
  const LensChoice lens{.width = size.width, .height = size.height};
  return kind == GeneratedKind::terrain ? camera_of_terrain(lens) : camera_of_soup(lens);
}

}  // namespace fathom::bench
