#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/study/pipeline_scenes.h"
#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

/// Meshes in every shading.
namespace fathom::studies {

/// A mesh of data/meshes, its file, and the camera that frames it: that of
/// `fathom render FILE --view … --size 212x212`.
struct GalleryMesh {
  SceneView view;
  StudyFile file;
  bool has_texture_coordinates = false;
  pipeline::NormalSource normals_from = pipeline::NormalSource::file;
};

/// Cube, house, spot and teapot. The teapot's file has many points twice, where its patches meet;
/// normals that are sums over the triangles at a vertex would show the patches.
std::vector<GalleryMesh> gallery_meshes();

/// The picture of a mesh; surfaces are multisampled, 8 samples.
RgbImage shaded(const GalleryMesh& mesh, pipeline::Shading shading,
                const std::string& texture = "");

}  // namespace fathom::studies

/// Files of data/meshes, so that the page's pictures need no folder of data (CMakeLists.txt).
namespace fathom::studies::mesh_texts {

extern const std::string_view cube, house, spot, teapot;

}  // namespace fathom::studies::mesh_texts
