#include "validation/scenes/generated/generated_stream.h"

#include <algorithm>

namespace fathom::bench {

std::optional<TriangleStream::Bounds> GeneratedStream::bounds() const {
  if (count_ == 0) return std::nullopt;
  return bounds_;
}

TriangleChunk GeneratedStream::read(std::uint32_t first, std::uint32_t count) const {
  first = std::min(first, count_);
  count = std::min(count, count_ - first);
  TriangleChunk chunk{.first = first, .mesh = {}};
  chunk.mesh.face_count = count;
  chunk.mesh.triangles.reserve(count);
  if (count > 0) add_triangles(first, first + count, chunk.mesh);
  return chunk;
}

}  // namespace fathom::bench
