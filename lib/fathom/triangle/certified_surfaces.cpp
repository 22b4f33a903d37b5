#include "fathom/triangle/certified_surfaces.h"

#include <cmath>

namespace fathom {

CertifiedSurfaces::CertifiedSurfaces(const SceneRays& rays)
    : rays_(rays),
      arithmetic_(wide_arithmetic()),
      image_{rays.perspective(), rays.greatest_u(), rays.greatest_v()} {}

CertifiedSurfaces::Triangle& CertifiedSurfaces::remember(std::uint32_t number) {
  return remembered_.get(number, [&](Triangle& t) {
    const TriangleSource::Triangle triangle = rays_.triangles().triangle(number);
    t.has_wide = t.has_weights = false;
    t.object = &rays_.object(triangle.origin.object);
    t.corners = triangle.corners;
    t.usable = t.object->usable && is_safe(t.corners);
    if (t.usable) t.depth = depth_forms<double>(t.corners, t.object->rays, image_);
  });
}

Certified<double> CertifiedSurfaces::depth(std::uint32_t number, const ImagePoint& s) {
  const Triangle& t = remember(number);
  if (!t.usable) return {};
  return t.depth.at(s, image_.perspective);
}

Certified<WordPair> CertifiedSurfaces::wide_depth(std::uint32_t number, const ImagePoint& s) {
  Triangle& t = remember(number);
  if (!t.usable) return {};
  if (!t.has_wide) {
    t.wide = arithmetic_.depth_forms(t.corners, t.object->rays, image_);
    t.has_wide = true;
  }
  return arithmetic_.depth(t.wide, s, image_.perspective);
}

std::array<Certified<double>, 3> CertifiedSurfaces::weights(std::uint32_t number,
                                                            const ImagePoint& s) {
  Triangle& t = remember(number);
  if (!t.usable) return {};
  if (!t.has_weights) {
    t.weights = weight_forms<double>(t.corners, t.object->rays, image_);
    t.has_weights = true;
  }
  const Certified<double> b = t.weights.at(0, s), c = t.weights.at(1, s);
  // 1 − b − c, two roundings.
  const double error = b.error + c.error + 0x1p-50 * (1 + std::abs(b.value) + std::abs(c.value));
  return {Certified<double>{1 - (b.value + c.value), error * (1 + 0x1p-40)}, b, c};
}

// A negative weight at a covered sample means D < 0, three positive ones where D > 0 that it is
// covered (WideReferee::covers).
bool CertifiedSurfaces::certainly_misses(std::uint32_t number, const ImagePoint& s) {
  for (const Certified<double>& weight : weights(number, s)) {
    if (weight.value + weight.error < 0) return true;
  }
  return false;
}

bool CertifiedSurfaces::certainly_covers(std::uint32_t number, const ImagePoint& s) {
  for (const Certified<double>& weight : weights(number, s)) {
    if (!(weight.value - weight.error > 0)) return false;
  }
  return true;
}

}  // namespace fathom
