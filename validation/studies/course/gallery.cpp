#include "validation/studies/course/gallery.h"

#include <algorithm>
#include <array>
#include <map>

#include "fathom/scene/framing.h"
#include "validation/studies/course/mesh_texts.h"

namespace fathom::studies {
namespace {

GalleryMesh framed(const StudyFile& file, const View& view) {
  GalleryMesh result{{file.name.substr(0, file.name.find('.')), scene_in(file), {}}, file};
  result.view.camera = frame_scene(result.view.scene, view, {.width = 212, .height = 212});
  result.has_texture_coordinates = std::ranges::all_of(
      result.view.scene.meshes, [](const Mesh& m) { return !m.texture_coordinates.empty(); });
  return result;
}

}  // namespace

Scene with_joined_vertices(Scene scene) {
  Mesh& mesh = scene.meshes.at(0);
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<MeshPoint> joined;
  std::vector<std::uint32_t> index;
  for (const MeshPoint& p : mesh.vertices) {
    const auto next = static_cast<std::uint32_t>(joined.size());
    const auto [found, is_new] = known.try_emplace({p.x, p.y, p.z}, next);
    if (is_new) joined.push_back(p);
    index.push_back(found->second);
  }
  mesh.vertices = std::move(joined);
  for (CornerIndices& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = index[corner];
  return scene;
}

std::vector<GalleryMesh> gallery_meshes() {
  const auto file = [](const char* name, std::string_view text) {
    return StudyFile{name, std::string(text)};
  };
  const StudyFile teapot{
      "teapot-joined.obj",
      obj_of(with_joined_vertices(scene_in(file("teapot.obj", mesh_texts::teapot))))};
  return {framed(file("cube.obj", mesh_texts::cube), {}),
          framed(file("house.gltf", mesh_texts::house), {}),
          framed(file("spot.obj", mesh_texts::spot), {.azimuth = 215, .elevation = 15}),
          framed(teapot, {})};
}

RgbImage shaded(const GalleryMesh& mesh, pipeline::Shading shading, const std::string& texture) {
  pipeline::PipelineOptions options;
  options.shading = shading;
  options.texture = texture;
  options.background = {0.1, 0.1, 0.15};
  const bool is_surface =
      shading != pipeline::Shading::points && shading != pipeline::Shading::wireframe;
  if (is_surface) options.antialias = {pipeline::AntialiasMethod::msaa, 8};
  return pipeline_picture(mesh.view, options);
}

}  // namespace fathom::studies
