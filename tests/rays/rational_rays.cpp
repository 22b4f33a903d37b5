#include "tests/rays/rational_rays.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "fathom/scene/triangle_source.h"
#include "tests/oracle/against_oracle.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom::rays::test {

std::vector<oracle::Triangle> rational_triangles(const Scene& scene) {
  const TriangleSource source(scene);
  std::vector<oracle::Triangle> triangles;
  for (std::uint32_t i = 0; i < source.count(); ++i) {
    oracle::Triangle triangle;
    const auto corners = source.world_corners(i);
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = {checks::rational(Ratio(corners[k].x)), checks::rational(Ratio(corners[k].y)),
                     checks::rational(Ratio(corners[k].z))};
    triangles.push_back(triangle);
  }
  return triangles;
}

oracle::GivenRay rational_ray(const Ray& ray) {
  return {oracle::exact_vector(ray.origin), oracle::exact_vector(ray.direction)};
}

oracle::Stretch rational_stretch(const CastOptions& options) {
  oracle::Stretch stretch{.first = std::nullopt, .open = options.segment.open};
  if (std::isfinite(options.segment.t_min)) stretch.first = oracle::Q(options.segment.t_min);
  if (std::isfinite(options.segment.t_max)) stretch.last = oracle::Q(options.segment.t_max);
  if (options.cull != Cull::none) stretch.left_out = options.cull == Cull::back ? 1 : -1;
  return stretch;
}

double rounded(const oracle::Q& q) {
  return oracle::quotient(oracle::binary64, q.get_mpq_t());
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace fathom::rays::test
