#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/reference/verify_samples.h"
#include "fathom/reference/view.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::reference {

/// The chosen pixels of some rows of an image whose rays a lens bends: the nearest triangle so far
/// along the exact ray of each.
class ChosenRays {
 public:
  /// All must outlive it.
  ChosenRays(const View& view, const ChosenRows& chosen, std::uint32_t first_row,
             std::uint32_t end_row);

  /// Tests a triangle at the chosen pixels of its box. Triangles come in the order of their
  /// numbers.
  void draw(triangle::ProjectedTriangle t, const PixelBox& box);

  /// Writes the visible surfaces, and which pixels have a ray, to a map that has a pixel for each
  /// chosen one; calls on_fault(pixel, why) where the encoding does not hold a value.
  void write(triangle::ChannelWriter& writer,
             const std::function<void(std::size_t, const std::string&)>& on_fault) const;

 private:
  struct Pixel {
    std::optional<lens::ExactDirection> ray;
    const triangle::ProjectedTriangle* nearest = nullptr;
  };

  const View& view_;
  const ChosenRows& chosen_;
  std::uint32_t first_row_, end_row_;
  std::vector<Pixel> pixels_;
  /// Those that are or were the nearest of a pixel.
  std::deque<triangle::ProjectedTriangle> triangles_;
};

}  // namespace fathom::reference
