#include "fathom/fast/pixels/surface_facts.h"

namespace fathom::fast {
using namespace triangle;

ValueFrame::ValueFrame(const SceneRays& its_rays)
    : rays(its_rays),
      wide(wide_arithmetic()),
      image{rays.perspective(), rays.greatest_u(), rays.greatest_v()},
      world_sizes(rays.world().rays, image) {}

SurfaceFacts surface_facts(std::uint32_t number, const ValueFrame& frame) {
  const TriangleSource::Triangle triangle = frame.rays.triangles().triangle(number);
  SurfaceFacts t;
  t.origin = triangle.origin;
  t.object = &frame.rays.object(t.origin.object);
  t.corners = triangle.corners;
  t.usable = t.object->usable && frame.rays.world().usable && is_safe(t.corners);
  return t;
}

const WeightForms<double>& weights_of(SurfaceFacts& t, const ValueFrame& frame) {
  if (!t.weights) t.weights = weight_forms<double>(t.corners, t.object->rays, frame.image);
  return *t.weights;
}

const DepthForms<WordPair>& depth_of(SurfaceFacts& t, const ValueFrame& frame) {
  if (!t.depth) t.depth = frame.wide.depth_forms(t.corners, t.object->rays, frame.image);
  return *t.depth;
}

const std::optional<WordPair>& constant_of(SurfaceFacts& t, std::size_t k) {
  if ((t.constants_known >> k & 1) != 0) return t.constants[k];
  t.constants_known |= static_cast<std::uint8_t>(1U << k);
  const ExactRow& row = k < 3 ? t.object->world_rows[k] : t.object->image_rows[2];
  const auto at_A = row.value_at(t.corners[0]);
  const auto is_at = [&](const MeshPoint& X) {
    const auto value = row.value_at(X);
    return value && value->hi == at_A->hi && value->lo == at_A->lo;
  };
  if (at_A && is_at(t.corners[1]) && is_at(t.corners[2])) t.constants[k] = at_A;
  return t.constants[k];
}

}  // namespace fathom::fast
