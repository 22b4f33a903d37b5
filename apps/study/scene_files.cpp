#include "apps/study/scene_files.h"

#include <fmt/format.h>

#include <span>

#include "fathom/camera/camera_files.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/read_scene.h"

namespace fathom::studies {
namespace {

std::string vertex_line(const Mesh& mesh, std::size_t i) {
  const MeshPoint& p = mesh.vertices[i];
  std::string line = fmt::format("v {} {} {}", p.x, p.y, p.z);
  if (!mesh.colours.empty()) {
    // As binary64, which has the same decimals for reading: they are rounded to binary32 only once.
    for (std::size_t k = 0; k < 3; ++k)
      line += fmt::format(" {}", static_cast<double>(mesh.colours[i][k]));
  }
  return line + "\n";
}

}  // namespace

std::string obj_of(const Scene& scene) {
  const Mesh& mesh = scene.meshes.at(0);
  std::string text;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) text += vertex_line(mesh, i);
  for (const auto& uv : mesh.texture_coordinates) text += fmt::format("vt {} {}\n", uv[0], uv[1]);
  const bool textured = !mesh.texture_coordinates.empty();
  for (const CornerIndices& t : mesh.triangles) {
    text += "f";
    for (const std::uint32_t i : t)
      text += textured ? fmt::format(" {0}/{0}", i + 1) : fmt::format(" {}", i + 1);
    text += "\n";
  }
  for (const auto& line : mesh.lines) text += fmt::format("l {} {}\n", line[0] + 1, line[1] + 1);
  return text;
}

Scene scene_in(const StudyFile& file) {
  ReadOptions options;
  options.attributes = options.primitives = true;
  options.hash = false;
  Warnings warnings;
  return read_scene(std::as_bytes(std::span(file.content)), file.name, options, warnings);
}

SceneFiles scene_files(const std::string& name, const Scene& scene, const Camera& camera) {
  const StudyFile mesh{name + ".obj", obj_of(scene)};
  const StudyFile seen{name + ".json", to_json(camera) + "\n"};
  return {{name, scene_in(mesh), read_cameras(seen.content, seen.name).at(0)}, {mesh, seen}};
}

RgbImage pipeline_picture(const SceneView& view, const pipeline::PipelineOptions& options) {
  return render_by_pipeline(view.scene, view.camera, options, {}, true).picture;
}

}  // namespace fathom::studies
