#pragma once

#include "validation/scenes/generated/generated_stream.h"

namespace fathom::bench {

/// Triangles anywhere in the unit cube, in no order at all: for ranks that draw parts of an image,
/// the worst that there is. Nothing is shared.
class SoupStream : public GeneratedStream {
 public:
  /// Each triangle lies in a cube of this edge, its corners anywhere in that.
  /// Needs    0 < edge ≤ 1.
  SoupStream(std::uint32_t count, double edge);
  [[nodiscard]] Triangle triangle(std::uint32_t number) const override;

 private:
  void add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const override;

  double edge_;
};

}  // namespace fathom::bench
