#include "fathom/rays/rounded_t.h"

#include <cmath>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/fused_multiply_add.h"
#include "fathom/numeric/rounding.h"
#include "fathom/rays/ray_tree.h"

namespace fathom::rays {
namespace {

/// Magnitudes with which no product of three differences over- or underflows in double-words.
bool is_safe(const Vector& v) {
  for (const double x : v) {
    const double size = std::abs(x);
    if (!(size <= greatest_safe) || (size < least_safe && size != 0)) return false;
  }
  return true;
}

/// v times 2^power into `to`, if that is exact and safe.
bool scale_safely(const std::array<double, 3>& v, long power, Vector& to) {
  for (std::size_t k = 0; k < 3; ++k) {
    to[k] = std::ldexp(v[k], static_cast<int>(power));
    if (to[k] == 0 && v[k] != 0) return false;
  }
  return is_safe(to);
}

template <bool fused>
using Number = Certified<DoubleWord<fused>>;

/// Differences of binary64 numbers are double-words exactly.
template <bool fused>
std::array<Number<fused>, 3> displacement(const Vector& to, const Vector& from) {
  std::array<Number<fused>, 3> result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = {two_sum(to[k], -from[k]), 0};
  return result;
}

/// n·(a − o) / n·d.
template <bool fused>
Certified<WordPair> t_in_double_words(const std::array<Vector, 3>& corners, const Vector& origin,
                                      const Vector& direction) {
  const auto p = displacement<fused>(corners[1], corners[0]);
  const auto r = displacement<fused>(corners[2], corners[0]);
  const auto from_origin = displacement<fused>(corners[0], origin);
  Number<fused> height{{}, 0}, along{{}, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Number<fused> first = product(p[i], r[j]), second = product(p[j], r[i]);
    const Number<fused> n = sum(first, Number<fused>{-second.value, second.error});
    height = sum(height, product(n, from_origin[k]));
    along = sum(along, product(n, Number<fused>{direction[k], 0}));
  }
  const Number<fused> t = quotient(height, along);
  return {t.value, t.error};
}

FATHOM_WITH_FMA Certified<WordPair> t_with_fma(const std::array<Vector, 3>& corners,
                                               const Vector& origin, const Vector& direction) {
  return t_in_double_words<true>(corners, origin, direction);
}

/// In the unit of the tree, with a direction of about 1. nullopt where that is not settled.
std::optional<double> settled_t(const RayScene& scene, const Ray& ray, const Candidates::Hit& hit) {
  const RayTree& tree = scene.tree();
  if (!tree.has_exact_corners(scene.triangles().origin(hit.first).object)) return std::nullopt;
  const long direction_power = power_of_direction(ray);
  Vector origin, direction;
  if (!scale_safely(ray.origin, -tree.power(), origin) ||
      !scale_safely(ray.direction, -direction_power, direction))
    return std::nullopt;
  const std::array<Vector, 3> corners = tree.corners(hit.place);
  for (const Vector& corner : corners)
    if (!is_safe(corner)) return std::nullopt;
  static const bool has_fma = processor_has_fma();
  const Certified<WordPair> t = has_fma ? t_with_fma(corners, origin, direction)
                                        : t_in_double_words<false>(corners, origin, direction);
  const auto settled = to_binary64(t.value, t.error);
  if (!settled) return std::nullopt;
  // Scaled back without another rounding: the result is normal.
  const auto power = static_cast<int>(tree.power() - direction_power);
  const double result = std::ldexp(*settled, power);
  if (*settled != 0 && !std::isnormal(result)) return std::nullopt;
  return result;
}

}  // namespace

double rounded_t(const RayScene& scene, const Ray& ray, Candidates& found,
                 const Candidates::Hit& hit) {
  if (const auto settled = settled_t(scene, ray, hit)) return *settled;
  return round_to_binary64(found.exact_t(hit));
}

}  // namespace fathom::rays
