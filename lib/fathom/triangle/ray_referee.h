#pragma once

#include <cstdint>

#include "fathom/lens/exact_direction.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/remembered_triangles.h"

namespace fathom::triangle {

/// The referee of a camera that bends rays: settles with exact numbers, along the ray of a sample,
/// what a bound did not settle. One for each thread: it remembers the triangles that it was asked
/// about last.
class RayReferee {
 public:
  RayReferee(const TriangleSource& triangles, const Camera& camera)
      : camera_(camera), remembered_(triangles, camera) {}

  /// Valid until the next question.
  const ProjectedTriangle& projected(std::uint32_t number) {
    remembered_.make_room();
    return remembered_.get(number);
  }

  bool covers(std::uint32_t number, const lens::ExactDirection& d, RenderStatistics& statistics);
  /// Whether D > 0 and near ≤ D ≤ far, where the triangle covers the sample; of a camera whose
  /// limits bound ray distances, whether those are between them.
  bool is_in_range(std::uint32_t number, const lens::ExactDirection& d,
                   RenderStatistics& statistics);
  /// Whether, at a sample that both cover, `a` hides `b`: it is nearer along the ray, or as near
  /// with the lower number.
  bool hides(std::uint32_t a, std::uint32_t b, const lens::ExactDirection& d,
             RenderStatistics& statistics);

 private:
  const Camera& camera_;
  RememberedTriangles remembered_;
};

}  // namespace fathom::triangle
