#include "validation/scenes/generated/generated_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/element_counts.h"
#include "validation/scenes/generated/generated_stream.h"
#include "validation/scenes/generated/terrain_heights.h"

namespace fathom::bench {
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
