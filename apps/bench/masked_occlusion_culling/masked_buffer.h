#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/camera/camera.h"

class MaskedOcclusionCulling;

namespace fathom::bench {

/// How Masked Occlusion Culling draws.
struct MaskedWay {
  /// Vectors of 512 bits instead of 256, if the processor has them.
  bool widest = true;
  /// Whether it transforms each vertex once, to memory, before it draws, or each corner of each
  /// triangle while it draws.
  bool vertices_first = true;
};

/// The depth buffer of Masked Occlusion Culling [HAA16]. For each block of 8×4 pixels it has two
/// depths and a mask that assigns one of them to each pixel. A depth is not nearer than the visible
/// surface, except for the roundings of binary32 and of corners on a grid of 1/256 pixel, and is
/// often farther.
///
/// Its input is the vertices in the world, in binary32, and the matrix from world to clip space. It
/// draws both sides of triangles. It clips at the near plane of attribution::clip_range(), as VTK
/// does, and has no far plane. It uses one thread.
///
/// Needs    a perspective camera, because its only depth is 1/w.
class MaskedBuffer {
 public:
  MaskedBuffer(const attribution::WorldMesh& mesh, const Camera& camera, const MaskedWay& way);

  void clear();
  /// All triangles, in the order of the mesh.
  void draw();
  /// The planar depth of each pixel in its buffer, row by row from the top; +∞ where it shows no
  /// surface.
  [[nodiscard]] std::vector<float> depths() const;
  /// "Masked Occlusion Culling, AVX-512, vertices first".
  [[nodiscard]] std::string description() const;

 private:
  /// x, y, nothing, z in the world; or x, y, z, w in clip space. Its fastest layout.
  using Vertex = std::array<float, 4>;

  std::unique_ptr<MaskedOcclusionCulling, void (*)(MaskedOcclusionCulling*)> moc_;
  std::uint32_t width_, height_;
  std::array<float, 16> clip_from_world_;  // column by column
  std::vector<Vertex> world_, clip_;
  std::vector<CornerIndices> triangles_;
  bool vertices_first_;
};

}  // namespace fathom::bench
