#include "apps/study/exact_picture.h"

#include "fathom/failures/errors.h"
#include "fathom/render.h"

namespace fathom::studies {
namespace {

using pipeline::Colour;

Colour colour_of(const Mesh& mesh, const CornerIndices& triangle) {
  if (mesh.colours.empty()) return {1, 1, 1};
  const auto& colour = mesh.colours[triangle[0]];
  if (mesh.colours[triangle[1]] != colour || mesh.colours[triangle[2]] != colour)
    throw InputError("a triangle's corners differ in colour; an exact picture takes one for each");
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]),
          static_cast<double>(colour[2])};
}

/// By the numbers of the triangles.
std::vector<Colour> colours_of(const Scene& scene) {
  std::vector<Colour> colours;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (const CornerIndices& triangle : mesh.triangles) {
      colours.push_back(colour_of(mesh, triangle));
    }
  }
  return colours;
}

}  // namespace

pipeline::ColourImage exact_picture(const Scene& scene, const Camera& camera,
                                    const Colour& background) {
  const DeepMap visible = render_deep(scene, camera);
  const std::vector<Colour> colours = colours_of(scene);
  pipeline::ColourImage image{camera.width, camera.height, {}};
  image.pixels.reserve(visible.counts.size());
  auto sample = visible.samples.begin();
  for (const std::uint32_t count : visible.counts) {
    Colour sum{};
    double uncovered = 1;
    const auto add = [&](const Colour& colour, double area) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += area * colour[k];
    };
    for (const auto end = sample + count; sample != end; ++sample) {
      const auto area = static_cast<double>(sample->area);
      add(colours[sample->id], area);
      uncovered -= area;
    }
    add(background, uncovered);
    image.pixels.push_back(sum);
  }
  return image;
}

}  // namespace fathom::studies
