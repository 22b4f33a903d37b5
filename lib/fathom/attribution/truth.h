#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

namespace fathom::attribution {

/// A number for each point of a mesh, the same for points at the same place: the least index among
/// them. So triangles that share an edge are recognised whatever indices a file gives them.
/// Exact    positions are compared bit by bit, but −0 is 0.
std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh);

/// The same for a mesh that a renderer holds in parts: points of two parts are never the same,
/// because two matrices transform them to the image. Positions are in the part's frame.
std::vector<std::uint32_t> corner_numbers(const std::vector<RasterPart>& parts);

/// The exact map of a comparison, and reusable data for comparing.
struct Truth {
  WorldMesh mesh;
  /// With the near and far that both renderers cut at; without its lens.
  Camera camera;
  /// For each point of the mesh: see corner_numbers().
  std::vector<std::uint32_t> corner_numbers;
  /// Rows from the top: depths in scene units, exact to 48 bits, infinite in the background; the
  /// visible triangles, no_surface there.
  std::vector<double> depths;
  std::vector<std::uint32_t> triangles;
  /// Where the samples lie, if the camera has a lens.
  std::shared_ptr<const LensSamples> lens = nullptr;
};

/// Renders it.
/// Fails    as render(), world_mesh() and LensSamples do.
Truth make_truth(const Scene& scene, const Camera& camera);

/// The camera that it was made for, with its lens.
const Camera& whole_camera(const Truth& truth);

/// The same mesh as another camera sees it. Fails as render() does.
Truth seen_by(const Truth& truth, const Camera& camera);

}  // namespace fathom::attribution
