#pragma once

#include "fathom/camera/camera.h"
#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

/// Scenes and cameras for studies of the pipeline.
namespace fathom::studies {

Scene scene_of(std::vector<MeshPoint> vertices, std::vector<CornerIndices> triangles);

/// In binary64, on a grid so fine that snapping has next to no say, and without shading.
pipeline::PipelineOptions precise_options();

/// At the origin, looking along +z with y down; the focal length is the width.
Camera front_camera(std::uint32_t width, std::uint32_t height, double near, double far);

/// Orthographic: the world's x and y are pixels.
Camera window_camera(std::uint32_t width, std::uint32_t height);

/// Gives each triangle a colour of its own, its corners copied.
void paint_each_triangle(Scene& scene);

/// Three long triangles in a ring, each before one and behind the other.
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

}  // namespace fathom::studies
