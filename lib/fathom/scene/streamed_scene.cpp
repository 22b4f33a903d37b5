#include "fathom/scene/streamed_scene.h"

#include "fathom/mesh/mesh_faces.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {
using namespace mesh;

StreamedScene stream_scene(const std::vector<std::filesystem::path>& files,
                           const ReadOptions& options, Warnings& warnings) {
  const StandardArithmetic standard;
  StreamedScene scene;
  for (const std::filesystem::path& path : files) {
    auto stream = open_triangle_stream(path, options, warnings);
    if (stream->triangle_count() == 0) warnings.push_back(path.string() + ": has no faces");
    Object object;
    object.mesh = object.source = scene.streams.size();
    object.name = path.stem().string();
    scene.sources.push_back(stream->source);
    scene.objects.push_back(std::move(object));
    scene.streams.push_back(std::move(stream));
    expect_countable(triangle_count(scene), "triangles in all", path.string());
  }
  return scene;
}

std::uint64_t triangle_count(const StreamedScene& scene) {
  return TriangleSource(scene).count();
}

TriangleOrigin origin_of(const StreamedScene& scene, std::uint32_t number) {
  return TriangleSource(scene).origin(number);
}

Scene outline_of(const StreamedScene& scene) {
  require_valid(scene);
  Scene outline;
  outline.objects = scene.objects;
  outline.sources = scene.sources;
  for (const auto& stream : scene.streams) {
    Mesh mesh;
    if (const auto bounds = stream->bounds()) {
      mesh.vertices = {bounds->lower, bounds->upper};
      mesh.triangles = {{0, 1, 1}};
      mesh.face_count = 1;
    }
    outline.meshes.push_back(std::move(mesh));
  }
  return outline;
}

}  // namespace fathom
