#pragma once

#include <cstdint>
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
  /// With the near and far that both renderers cut at.
  Camera camera;
  /// For each point of the mesh: see corner_numbers().
  std::vector<std::uint32_t> corner_numbers;
  /// Rows from the top: depths in scene units, exact to 48 bits, infinite in the background; the
  /// visible triangles, no_surface there.
  std::vector<double> depths;
  std::vector<std::uint32_t> triangles;
};

/// Renders it. Fails as render() and world_mesh() do.
Truth make_truth(const Scene& scene, const Camera& camera);

/// The same mesh as another camera sees it. Fails as render() does.
Truth seen_by(const Truth& truth, const Camera& camera);

}  // namespace fathom::attribution
