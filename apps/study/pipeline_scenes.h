#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

/// Scenes and cameras for studies of the pipeline.
namespace fathom::studies {

Scene scene_of(std::vector<MeshPoint> vertices, std::vector<CornerIndices> triangles);

/// In binary64, without shading, and on so fine a grid that snapping has almost no effect.
pipeline::PipelineOptions precise_options();

/// At the origin, looking along +z with y down; the focal length is the width.
Camera front_camera(std::uint32_t width, std::uint32_t height, double near, double far);

/// Orthographic: the world's x and y are pixels.
Camera window_camera(std::uint32_t width, std::uint32_t height);

/// Gives each triangle a different colour, and its own copies of its corners.
void paint_each_triangle(Scene& scene);

/// Three long triangles in a ring, each in front of one of the others and behind the other.
Scene cyclic_overlap();
/// Two triangles that go through each other.
Scene penetration();
/// Triangles at random, of about the same size.
Scene random_triangles(std::uint32_t count, std::uint64_t seed);
/// A level ground of `size` by `size` with texture coordinates that repeat every `tile`, seen from
/// `height` above.
Scene ground(double size, double tile, double height);
/// Narrow triangles around a point, all slopes of edges: a star of 2·`points` edges.
Scene siemens_star(std::uint32_t points, double radius, double cx, double cy);

// Scenes and cameras of the page's pictures are files next to the page, so that the commands in its
// captions draw the pictures again.

/// A scene and its camera, and their files: NAME.obj and NAME.json. `view` has been read back from
/// these files.
struct SceneFiles {
  SceneView view;
  std::vector<StudyFile> files;
};
/// `scene` has one mesh, and attributes for each vertex if any.
SceneFiles scene_files(const std::string& name, const Scene& scene, const Camera& camera);

/// The OBJ file of a scene of one mesh. Reading it returns the same numbers.
std::string obj_of(const Scene& scene);

/// The scene that `fathom render FILE` reads.
Scene scene_in(const StudyFile& file);

/// The picture that `fathom render --engine pipeline --image` draws.
RgbImage pipeline_picture(const SceneView& view, const pipeline::PipelineOptions& options);

}  // namespace fathom::studies
