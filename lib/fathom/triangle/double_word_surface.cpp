#include "fathom/triangle/double_word_surface.h"

#include <cmath>

#include "fathom/numeric/fused_multiply_add.h"

namespace fathom::triangle {
namespace {

template <class To, class From>
Certified<To> as(const Certified<From>& x) {
  return {x.value, x.error};
}

template <class To, class From>
Form<To> as(const Form<From>& f) {
  return {f.a, f.b, f.c, f.error};
}

template <class To, class From>
DepthForms<To> as(const DepthForms<From>& f) {
  return {as<To>(f.varying), as<To>(f.constant)};
}

template <class To, class From>
Vector<Certified<To>> as(const Vector<Certified<From>>& v) {
  return {as<To>(v[0]), as<To>(v[1]), as<To>(v[2])};
}

template <bool fused>
struct Wide {
  using Real = DoubleWord<fused>;

  static DepthForms<WordPair> depth_forms(const MeshTriangle& corners, const Rays& rays,
                                          const ImageBounds& image) {
    return as<WordPair>(triangle::depth_forms<Real>(corners, rays, image));
  }
  static Certified<WordPair> depth(const DepthForms<WordPair>& forms, const ImagePoint& s,
                                   bool perspective) {
    return as<WordPair>(as<Real>(forms).at(s, perspective));
  }
  static Certified<WordPair> distance(const Certified<WordPair>& depth, const SceneRays& rays,
                                      const ImagePoint& s) {
    return as<WordPair>(product(as<Real>(depth), ray_length<Real>(rays, s)));
  }
  static Vector<Certified<WordPair>> position(const Rays& rays, const RaySizes& sizes,
                                              bool perspective, const ImagePoint& s,
                                              const Certified<WordPair>& depth) {
    return as<WordPair>(triangle::position(rays, sizes, perspective, s, as<Real>(depth)));
  }
  static WeightForms<WordPair> weight_forms(const MeshTriangle& corners, const Rays& rays,
                                            const ImageBounds& image) {
    const auto forms = triangle::weight_forms<Real>(corners, rays, image);
    return {{as<WordPair>(forms.weights[0]), as<WordPair>(forms.weights[1])},
            as<WordPair>(forms.divisor)};
  }
  static std::array<Certified<WordPair>, 2> weights(const MeshTriangle& corners, const Rays& rays,
                                                    const ImageBounds& image, const ImagePoint& s) {
    const auto forms = triangle::weight_forms<Real>(corners, rays, image);
    return {as<WordPair>(forms.at(0, s)), as<WordPair>(forms.at(1, s))};
  }
  static Vector<Certified<WordPair>> normal(const MeshTriangle& corners, const ObjectRays& object,
                                            const ObjectRays& world, const ImageBounds& image,
                                            const ImagePoint& s) {
    return as<WordPair>(unit_normal<Real>(corners, object, world, image, s));
  }
  static Vector<Certified<WordPair>> camera_normal(const MeshTriangle& corners,
                                                   const ObjectRays& object,
                                                   const ObjectRays& world,
                                                   const ImageBounds& image, const ImagePoint& s,
                                                   Sign handedness) {
    return as<WordPair>(unit_camera_normal<Real>(corners, object, world, image, s, handedness));
  }
};

FATHOM_WITH_FMA DepthForms<WordPair> depth_forms_with_fma(const MeshTriangle& corners,
                                                          const Rays& rays,
                                                          const ImageBounds& image) {
  return Wide<true>::depth_forms(corners, rays, image);
}
FATHOM_WITH_FMA Certified<WordPair> depth_with_fma(const DepthForms<WordPair>& forms,
                                                   const ImagePoint& s, bool perspective) {
  return Wide<true>::depth(forms, s, perspective);
}
FATHOM_WITH_FMA Certified<WordPair> distance_with_fma(const Certified<WordPair>& depth,
                                                      const SceneRays& rays, const ImagePoint& s) {
  return Wide<true>::distance(depth, rays, s);
}
FATHOM_WITH_FMA Vector<Certified<WordPair>> position_with_fma(const Rays& rays,
                                                              const RaySizes& sizes,
                                                              bool perspective, const ImagePoint& s,
                                                              const Certified<WordPair>& depth) {
  return Wide<true>::position(rays, sizes, perspective, s, depth);
}
FATHOM_WITH_FMA WeightForms<WordPair> weight_forms_with_fma(const MeshTriangle& corners,
                                                            const Rays& rays,
                                                            const ImageBounds& image) {
  return Wide<true>::weight_forms(corners, rays, image);
}
FATHOM_WITH_FMA std::array<Certified<WordPair>, 2> weights_with_fma(const MeshTriangle& corners,
                                                                    const Rays& rays,
                                                                    const ImageBounds& image,
                                                                    const ImagePoint& s) {
  return Wide<true>::weights(corners, rays, image, s);
}
FATHOM_WITH_FMA Vector<Certified<WordPair>> normal_with_fma(const MeshTriangle& corners,
                                                            const ObjectRays& object,
                                                            const ObjectRays& world,
                                                            const ImageBounds& image,
                                                            const ImagePoint& s) {
  return Wide<true>::normal(corners, object, world, image, s);
}
FATHOM_WITH_FMA Vector<Certified<WordPair>> camera_normal_with_fma(
    const MeshTriangle& corners, const ObjectRays& object, const ObjectRays& world,
    const ImageBounds& image, const ImagePoint& s, Sign handedness) {
  return Wide<true>::camera_normal(corners, object, world, image, s, handedness);
}
}  // namespace

const WideArithmetic wide_without_fma{Wide<false>::depth_forms,  Wide<false>::depth,
                                      Wide<false>::distance,     Wide<false>::position,
                                      Wide<false>::weight_forms, Wide<false>::weights,
                                      Wide<false>::normal,       Wide<false>::camera_normal};
const WideArithmetic wide_with_fma{depth_forms_with_fma, depth_with_fma,        distance_with_fma,
                                   position_with_fma,    weight_forms_with_fma, weights_with_fma,
                                   normal_with_fma,      camera_normal_with_fma};

const WideArithmetic& wide_arithmetic() {
  static const WideArithmetic& chosen = processor_has_fma() ? wide_with_fma : wide_without_fma;
  return chosen;
}

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

// At a covered sample, a negative weight means D < 0; where D > 0, three positive weights mean that
// the sample is covered (WideReferee::covers()).
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

}  // namespace fathom::triangle
