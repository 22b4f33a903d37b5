// The bound on the length of a sample's ray, over cameras of all angles of view and with the centre
// anywhere: never violated, and not looser than a stated factor.
#include <gtest/gtest.h>

#include "fathom/triangle/double_word_surface.h"
#include "tests/effort.h"
#include "tests/inputs/scene_building.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::Numbers;
using checks::Share;

Camera camera_from(Numbers& n) {
  Camera c = checks::camera_of(64, 64, 0);
  const double size = std::ldexp(1, 3 + n.below(8));
  c.projection.fx = size * (1.5 + n.unit() / 2);
  c.projection.fy = size * (1.5 + n.unit() / 2);
  c.projection.skew = n.below(2) ? n.unit() : 0;
  c.projection.cx = n.below(2) ? n.unit() * 64 : 0.5;
  c.projection.cy = n.below(2) ? n.unit() * 64 : 0.5;
  return c;
}

/// The ray leads through (x, y, 1): u = fx·x + skew·y + cx + ½ − c, v = fy·y + cy + ½ − c, c being
/// where a pixel's centre is.
Ratio exact_length(const Camera& c, const ImagePoint& s) {
  const Dyadic half_less_centre = Dyadic(0.5) - c.projection.pixel_centre;
  const Ratio y(Dyadic(s.v) - Dyadic(c.projection.cy) - half_less_centre, c.projection.fy);
  const Ratio across = Ratio(Dyadic(s.u) - Dyadic(c.projection.cx) - half_less_centre) -
                       Ratio(c.projection.skew) * y;
  const Ratio x = quotient(across, Ratio(c.projection.fx));
  return checks::root(x * x + y * y + Ratio(1.0));
}

TEST(RayLengthShares, InBothArithmetics) {
  Numbers n(44);
  Share binary64, double_words;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    const Camera camera = camera_from(n);
    const SceneRays rays(checks::scene_of({}, {}), camera);
    const ImagePoint s{n.below(64) + 0.5, n.below(64) + 0.5};
    const Ratio exact = exact_length(camera, s);
    binary64.add(ray_length<double>(rays, s), exact);
    double_words.add(ray_length<DoubleWord<false>>(rays, s), exact);
  }
  checks::expect_share(binary64.publish("binary64"), 0.12);
  checks::expect_share(double_words.publish("double_words"), 0.012);
}

}  // namespace
}  // namespace fathom
