#include "apps/study/course/gallery.h"

#include <algorithm>

#include "fathom/scene/framing.h"

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

std::vector<GalleryMesh> gallery_meshes() {
  const auto file = [](const char* name, std::string_view text) {
    return StudyFile{name, std::string(text)};
  };
  GalleryMesh teapot = framed(file("teapot.obj", mesh_texts::teapot), {});
  teapot.normals_from = pipeline::NormalSource::place;
  return {framed(file("cube.obj", mesh_texts::cube), {}),
          framed(file("house.gltf", mesh_texts::house), {}),
          framed(file("spot.obj", mesh_texts::spot), {.azimuth = 215, .elevation = 15}), teapot};
}

RgbImage shaded(const GalleryMesh& mesh, pipeline::Shading shading, const std::string& texture) {
  pipeline::PipelineOptions options;
  options.shading = shading;
  options.texture = texture;
  options.normals_from = mesh.normals_from;
  options.background = {0.1, 0.1, 0.15};
  const bool is_surface =
      shading != pipeline::Shading::points && shading != pipeline::Shading::wireframe;
  if (is_surface) options.antialias = {pipeline::AntialiasMethod::msaa, 8};
  return pipeline_picture(mesh.view, options);
}

}  // namespace fathom::studies
