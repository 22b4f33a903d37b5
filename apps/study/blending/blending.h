#pragma once

#include <string>
#include <vector>

#include "apps/study/study.h"
#include "fathom/pipeline/render_pipeline.h"

/// Transparent surfaces in the orders in which a pipeline can draw them, against the exact order at
/// every pixel.
namespace fathom::studies {

/// Triangles of coloured glass, each with a colour of its own, and at times an opaque wall.
struct GlassScene {
  std::string name;
  Scene scene;  ///< objects with an opacity are glass
  pipeline::ColourImage exact;
};
inline constexpr const char* glass_scenes[] = {"panes", "wall", "ring", "penetration"};
GlassScene glass_scene(const std::string& name);

/// What each pixel's centre shows: every surface there, in the exact order of depths, blended from
/// the farthest to the nearest; nothing behind an opaque surface. Orders are exact, colours are
/// computed in binary64.
pipeline::ColourImage exactly_blended(const Scene& scene, const Camera& camera,
                                      const pipeline::Colour& background);

/// A way to draw glass, and how far its picture is from the exact one.
struct BlendedCase {
  std::string scene, method;
  std::size_t seen = 0;  ///< pixels with a surface
  std::size_t wrong = 0;
  double mean_error = 0, greatest_error = 0;  ///< of a colour's component, over pixels with surface
  RgbImage picture;
  std::string name;     ///< of the picture and of the scene file
  StudyFile file;       ///< the scene, with the state of each object
  std::string command;  ///< draws the picture from it, from mesh_files_of() and glass_camera_file()
};

inline constexpr const char* blending_methods[] = {"file order",
                                                   "file order, depth test",
                                                   "file order, read-only depth",
                                                   "random order",
                                                   "front to back",
                                                   "back to front",
                                                   "back to front, read-only depth",
                                                   "painter's algorithm"};

/// The mesh of each object, which the scene files of the cases name.
std::vector<StudyFile> mesh_files_of(const GlassScene& glass);
/// camera.json, for all scenes.
StudyFile glass_camera_file();

BlendedCase blend(const GlassScene& glass, const std::string& method);

}  // namespace fathom::studies
