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

/// How Masked Occlusion Culling is asked to draw.
struct MaskedWay {
  /// Vectors of 512 bits rather than 256, where the processor has them.
  bool widest = true;
  /// It transforms each vertex once, to memory, and then draws; or each corner of each triangle
  /// while it draws.
  bool vertices_first = true;
};

/// What is drawn by Masked Occlusion Culling [HAA16]: per block of 8×4 pixels two depths and a mask
/// that says which pixel has which; each depth is no nearer than what is seen there, as far as
/// binary32 and corners on a grid of 1/256 pixel allow, and often farther.
///
/// It is given the vertices in the world, in binary32, and the matrix from there to clip space;
/// both sides of triangles are drawn; it clips at the near plane of attribution::clip_range(), as
/// VTK does, and knows no far plane. One thread.
///
/// Needs    a perspective camera; it has no other depth than 1/w.
class MaskedBuffer {
 public:
  MaskedBuffer(const attribution::WorldMesh& mesh, const Camera& camera, const MaskedWay& way);

  void clear();
  /// All triangles, in the order of the mesh.
  void draw();
  /// The planar depth of each pixel, row by row from the top, as its buffer has it; +∞ where it
  /// shows no surface.
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
