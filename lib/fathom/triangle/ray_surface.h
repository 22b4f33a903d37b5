#pragma once

#include <array>
#include <cstddef>

#include "fathom/rendering/channel_values.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/ray_values.h"

namespace fathom::triangle {

/// A visible triangle of a camera that bends rays, prepared for many of its pixels: P, bary,
/// distance and Z in binary32, as far as binary64 settles them.
class RaySurface {
 public:
  /// The channels that it writes, of those that were asked for; Z where a caller sets that.
  struct Wanted {
    explicit Wanted(const rendering::ChannelValues& values)
        : position(values.position[0] != nullptr),
          barycentric(values.barycentric[0] != nullptr),
          distance(values.distance.binary32 != nullptr) {}
    [[nodiscard]] bool any() const { return position || barycentric || distance || depth; }

    bool position, barycentric, distance, depth = false;
  };

  RaySurface(const ProjectedTriangle& triangle, const Wanted& wanted);

  /// Writes them at a pixel whose ray lies in the box. False where one of them is not settled: the
  /// pixel then has to be written from exact numbers.
  [[nodiscard]] bool write(std::size_t pixel, const RayBox& box,
                           const rendering::ChannelValues& values) const;

 private:
  Wanted wanted_;
  std::array<LinearForm, 3> position_;
  std::array<LinearForm, 2> barycentric_;
  LinearForm depth_, weight_;
  Dyadic volume_;
};

}  // namespace fathom::triangle
