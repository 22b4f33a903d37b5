#include "fathom/triangle/double_word_referee.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/dyadic.h"

namespace fathom::triangle {
namespace {

using Word = DoubleWord<false>;

Certified<WordPair> difference(const Certified<WordPair>& x, const Certified<WordPair>& y) {
  const Certified<Word> result = sum<Word>({Word(x.value), x.error}, {-Word(y.value), y.error});
  return {result.value, result.error};
}

std::optional<int> sign_of_difference(const Certified<WordPair>& x, const Certified<WordPair>& y) {
  const Certified<WordPair> d = difference(x, y);
  return certain_sign(d.value, d.error);
}

Certified<WordPair> exactly(double x) {
  return {{x, 0}, 0};
}

}  // namespace

WideReferee::WideReferee(const SceneRays& rays)
    : rays_(rays),
      wide_(wide_arithmetic()),
      image_{rays.perspective(), rays.greatest_u(), rays.greatest_v()} {}

WideReferee::Triangle& WideReferee::remember(std::uint32_t number) {
  return remembered_.get(number, [&](Triangle& t) {
    const TriangleSource::Triangle triangle = rays_.triangles().triangle(number);
    t.has_depth = false;
    t.object_number = triangle.origin.object;
    t.object = &rays_.object(t.object_number);
    t.corners = triangle.corners;
    t.usable = t.object->usable && is_safe(t.corners);
  });
}

Certified<WordPair> WideReferee::depth_at(std::uint32_t number, const ImagePoint& s) {
  Triangle& t = remember(number);
  if (!t.usable) return {};
  if (!t.has_depth) {
    t.depth = wide_.depth_forms(t.corners, t.object->rays, image_);
    t.has_depth = true;
  }
  return wide_.depth(t.depth, s, image_.perspective);
}

// The weights are β = e_B/S, γ = e_C/S, α = 1 − β − γ with S = e_A + e_B + e_C, and the sample is
// covered only where all e/Δ ≥ 0, and certainly where all are > 0. Perspective: D = Δ/S, so where D
// > 0 the weights have the signs of e/Δ; where D < 0 the sum of the e/Δ is negative and so is one
// of them. Orthographic: S = Δ. A negative weight therefore means "no" in either case, and three
// positive weights mean "yes" if D > 0.
std::optional<bool> WideReferee::covers(std::uint32_t number, const ImagePoint& s) {
  const Triangle& t = remember(number);
  if (!t.usable) return std::nullopt;
  const auto weights = wide_.weights(t.corners, t.object->rays, image_, s);
  const Certified<WordPair> alpha = difference(difference(exactly(1), weights[0]), weights[1]);
  bool all_positive = true;
  for (const Certified<WordPair>& weight : {weights[0], weights[1], alpha}) {
    const auto sign = certain_sign(weight.value, weight.error);
    if (sign && *sign < 0) return false;
    all_positive = all_positive && sign;
  }
  if (!all_positive) return std::nullopt;
  if (!image_.perspective) return true;
  const Certified<WordPair> depth = depth_at(number, s);
  const auto sign = certain_sign(depth.value, depth.error);
  if (!sign) return std::nullopt;
  return *sign > 0;
}

std::optional<WideForms> WideReferee::forms(std::uint32_t number) {
  const Triangle& t = remember(number);
  if (!t.usable || !image_.perspective) return std::nullopt;
  const ImageBounds image{true, image_.u + WideForms::beyond, image_.v + WideForms::beyond};
  return WideForms{wide_.weight_forms(t.corners, t.object->rays, image),
                   wide_.depth_forms(t.corners, t.object->rays, image).constant, image.u, image.v};
}

std::optional<int> WideReferee::compare_depth(std::uint32_t number, const ImagePoint& s,
                                              double limit) {
  return sign_of_difference(depth_at(number, s), exactly(limit));
}

std::optional<int> WideReferee::compare_depths(std::uint32_t a, std::uint32_t b,
                                               const ImagePoint& s) {
  const Certified<WordPair> depth_of_a = depth_at(a, s);
  return sign_of_difference(depth_of_a, depth_at(b, s));
}

bool WideReferee::lie_in_one_plane(std::uint32_t a, std::uint32_t b) {
  const Triangle first = remember(a);  // a copy: both may share a slot
  const Triangle& second = remember(b);
  const bool same_frame = first.object_number == second.object_number ||
                          (first.object->placed_as_is && second.object->placed_as_is);
  return same_frame && certainly_coplanar(first.corners, second.corners);
}

namespace {

using Whole = std::array<std::int64_t, 3>;
__extension__ using Integer128 = __int128;

bool is_one_of(const MeshPoint& X, const MeshTriangle& t) {
  return std::any_of(t.begin(), t.end(),
                     [&](const MeshPoint& Y) { return X.x == Y.x && X.y == Y.y && X.z == Y.z; });
}

}  // namespace

// Six points as integer multiples of a common unit, below 2³⁹ in magnitude: differences are below
// 2⁴⁰, components of the normal below 2⁸¹, its product with a difference below 2¹²³.
bool certainly_coplanar(const MeshTriangle& a, const MeshTriangle& b) {
  if (std::all_of(b.begin(), b.end(), [&](const MeshPoint& X) { return is_one_of(X, a); })) {
    return true;
  }
  const MeshPoint points[] = {a[0], a[1], a[2], b[0], b[1], b[2]};
  int unit = 1024;
  double greatest = 0;
  for (const MeshPoint& X : points) {
    for (const double x : {X.x, X.y, X.z}) {
      unit = static_cast<int>(std::min<long>(unit, last_bit(x)));
      greatest = std::max(greatest, std::abs(x));
    }
  }
  if (std::ldexp(greatest, -unit) >= 0x1p39) return false;
  const auto from_first = [&](const MeshPoint& X) {
    const auto whole = [&](double x) { return static_cast<std::int64_t>(std::ldexp(x, -unit)); };
    return Whole{whole(X.x) - whole(a[0].x), whole(X.y) - whole(a[0].y),
                 whole(X.z) - whole(a[0].z)};
  };
  const Whole p = from_first(a[1]), r = from_first(a[2]);
  const auto minor = [&](std::size_t i, std::size_t j) {
    return static_cast<Integer128>(p[i]) * r[j] - static_cast<Integer128>(p[j]) * r[i];
  };
  const Integer128 normal[] = {minor(1, 2), minor(2, 0), minor(0, 1)};
  return std::all_of(b.begin(), b.end(), [&](const MeshPoint& X) {
    const Whole d = from_first(X);
    return normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2] == 0;
  });
}

}  // namespace fathom::triangle
