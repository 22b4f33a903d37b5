// The bounds of the channels' values from both sides: never violated against exact values, and not
// looser than a stated factor. In binary64 and in double-words, with and without fused
// multiply-add.
#include "fathom/triangle/double_word_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/scene_building.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::Numbers;
using checks::root;
using checks::Share;

Camera camera_from(Numbers& n, bool perspective) {
  Camera c = checks::camera_of(200, 150, 0);
  c.projection.model = perspective ? ProjectionModel::perspective : ProjectionModel::orthographic;
  do {
    const double size = perspective ? 140 : 60;
    c.projection.fx = (n.below(2) ? 1 : -1) * size * (1 + n.unit() / 2);
    c.projection.fy = (n.below(2) ? 1 : -1) * size * (1 + n.unit() / 2);
    c.projection.skew = n.below(2) ? n.unit() * 20 : 0;
    c.projection.cx = 100 + n.unit();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        c.world_to_camera[i][k] = (i == k) + n.unit() * (n.below(2) ? 0.3 : 0);
      }
      c.world_to_camera[i][3] = n.unit() * 0.3 + (i == 2 ? 3 : 0);
    }
  } while (find_fault(c));
  return c;
}

Object object_from(Numbers& n) {
  Object object;
  if (n.below(2)) return object;
  object.placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      object.world_from_mesh.rows[i][k] = Dyadic((i == k) + 0.2 * n.unit());
    }
  }
  return object;
}

/// Triangles of all sizes, some thin, some of few bits.
MeshTriangle corners_from(Numbers& n) {
  MeshTriangle t;
  for (MeshPoint& X : t) X = {n.unit(), n.unit(), n.unit()};
  if (n.below(3) == 0) {
    const double s = std::ldexp(1, -n.below(14)), k = n.unit();
    t[2] = {t[0].x + k * (t[1].x - t[0].x) + s * n.unit(),
            t[0].y + k * (t[1].y - t[0].y) + s * n.unit(), t[2].z};
  }
  if (n.below(3) == 0) {
    for (MeshPoint& X : t) X = {std::round(X.x * 8) / 8, std::round(X.y * 8) / 8, X.z};
  }
  return t;
}

/// A triangle seen at a sample that it covers.
struct SeenSurface {
  MeshTriangle corners;
  const ObjectRays& object;
  const SceneRays& rays;
  ImageBounds image;
  ImagePoint s;
};

struct Binary64 {
  using Real = double;
  static DepthForms<double> forms(const SeenSurface& x) {
    return depth_forms<double>(x.corners, x.object.rays, x.image);
  }
  static Certified<double> depth(const SeenSurface& x) {
    return depth_forms<double>(x.corners, x.object.rays, x.image).at(x.s, x.image.perspective);
  }
  static Certified<double> distance(const SeenSurface& x) {
    return product(depth(x), ray_length<double>(x.rays, x.s));
  }
  static auto position(const SeenSurface& x) {
    const Rays& world = x.rays.world().rays;
    return fathom::position(world, RaySizes(world, x.image), x.image.perspective, x.s, depth(x));
  }
  static auto weights(const SeenSurface& x) {
    const auto forms = weight_forms<double>(x.corners, x.object.rays, x.image);
    return std::array{forms.at(0, x.s), forms.at(1, x.s)};
  }
  static auto normal(const SeenSurface& x) {
    return unit_normal<double>(x.corners, x.object, x.rays.world(), x.image, x.s);
  }
};

template <const WideArithmetic& wide>
struct Wide {
  using Real = DoubleWord<false>;
  static DepthForms<Real> forms(const SeenSurface& x) {
    const auto f = wide.depth_forms(x.corners, x.object.rays, x.image);
    return {{f.varying.a, f.varying.b, f.varying.c, f.varying.error},
            {f.constant.value, f.constant.error}};
  }
  static Certified<WordPair> depth(const SeenSurface& x) {
    return wide.depth(wide.depth_forms(x.corners, x.object.rays, x.image), x.s,
                      x.image.perspective);
  }
  static auto distance(const SeenSurface& x) { return wide.distance(depth(x), x.rays, x.s); }
  static auto position(const SeenSurface& x) {
    const Rays& world = x.rays.world().rays;
    return wide.position(world, RaySizes(world, x.image), x.image.perspective, x.s, depth(x));
  }
  static auto weights(const SeenSurface& x) {
    return wide.weights(x.corners, x.object.rays, x.image, x.s);
  }
  static auto normal(const SeenSurface& x) {
    return wide.normal(x.corners, x.object, x.rays.world(), x.image, x.s);
  }
};

struct Shares {
  Share varying, constant, edges, depth, distance, position, weights, normal;
  /// Of what the normal and the distance are computed from.
  Share mesh_normal, placed_normal, length, turn, ray_length;
};

/// det(H), H being the linear part of the map from a mesh, or the world, to (U, V, D), with the
/// sign that ProjectedTriangle gives to its forms.
Dyadic determinant_of(const ObjectRays& object, const ProjectedTriangle& t) {
  std::array<ExactVector3, 3> H;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) H[i][k] = object.image_rows[i].coefficients[k];
  }
  const Dyadic det = determinant(H[0], H[1], H[2]);
  return t.orientation == Sign::negative ? -det : det;
}

/// The parts of depth and weights, before quotients and differences cover their errors: n·d is
/// Σe/det H, n·t is Δ/det H, d·(r × t) and d·(t × p) are e_B/det H and e_C/det H.
template <class Arithmetic>
void add_shares_of_parts(const SeenSurface& x, const ProjectedTriangle& t, Shares& shares) {
  using Real = typename Arithmetic::Real;
  const Dyadic det = determinant_of(x.object, t);
  const auto over_det = [&](const LinearForm& form) { return Ratio(form.at(x.s.u, x.s.v), det); };
  const DepthForms<Real> forms = Arithmetic::forms(x);
  const auto& [varying, constant] = x.image.perspective ? std::pair{t.weight, t.depth_numerator}
                                                        : std::pair{t.depth_numerator, t.weight};
  shares.varying.add(forms.varying.at(x.s), over_det(varying));
  shares.constant.add(forms.constant, over_det(constant));
  const WeightForms<Real> weights = weight_forms<Real>(x.corners, x.object.rays, x.image);
  shares.varying.add(weights.divisor.at(x.s), over_det(t.weight));
  shares.edges.add(weights.weights[0].at(x.s), over_det(t.edges[1]));
  shares.edges.add(weights.weights[1].at(x.s), over_det(t.edges[2]));
}

/// The parts of the unit normal, n = p × r in the world: its components, |n|, n·d.
template <class Real>
void add_shares_of_normal(const SeenSurface& x, const ProjectedTriangle& t, const ExactVector3& n,
                          Shares& shares) {
  const PlacedNormal<Real> normal = world_normal<Real>(x.corners, x.object);
  const Vector<double> errors = errors_of(normal);
  Share& components = x.object.placed_as_is ? shares.mesh_normal : shares.placed_normal;
  for (std::size_t i = 0; i < 3; ++i) {
    components.add(Certified<Real>{normal.n[i], errors[i]}, Ratio(n[i]));
  }
  shares.length.add(length_of(normal.n, errors_of(normal)), root(Ratio(dot(n, n))));
  const Dyadic det = determinant_of(x.rays.world(), t);
  shares.turn.add(along_ray(normal, x.rays.world().rays, x.image, x.s),
                  Ratio(t.weight.at(x.s.u, x.s.v), det));
}

template <class Arithmetic>
void add_shares(const SeenSurface& x, const ProjectedTriangle& t, Sign handedness, Shares& shares) {
  const ImagePoint s{x.s.u, x.s.v};
  add_shares_of_parts<Arithmetic>(x, t, shares);
  shares.depth.add(Arithmetic::depth(x), depth_at(t, s));
  const auto weights = Arithmetic::weights(x);
  shares.weights.add(weights[0], interpolate(t, s, {0.0, 1.0, 0.0}));
  shares.weights.add(weights[1], interpolate(t, s, {0.0, 0.0, 1.0}));
  const auto& [A, B, C] = t.world;
  const auto position = Arithmetic::position(x);
  shares.position.add(position[0], interpolate(t, s, {A.x, B.x, C.x}));
  shares.position.add(position[1], interpolate(t, s, {A.y, B.y, C.y}));
  shares.position.add(position[2], interpolate(t, s, {A.z, B.z, C.z}));
  if (x.image.perspective) {
    const auto& [a, b, c] = t.camera;
    const Ratio X = interpolate(t, s, {a.x, b.x, c.x}), Y = interpolate(t, s, {a.y, b.y, c.y});
    const Ratio Z = depth_at(t, s);
    const Ratio squared = X * X + Y * Y + Z * Z;
    shares.distance.add(Arithmetic::distance(x), root(squared));
    shares.ray_length.add(ray_length<typename Arithmetic::Real>(x.rays, x.s),
                          root(quotient(squared, Z * Z)));
  }
  const ExactVector3 n = cross(ExactVector3{B.x - A.x, B.y - A.y, B.z - A.z},
                               ExactVector3{C.x - A.x, C.y - A.y, C.z - A.z});
  add_shares_of_normal<typename Arithmetic::Real>(x, t, n, shares);
  const auto normal = Arithmetic::normal(x);
  for (std::size_t i = 0; i < 3; ++i) {
    const Ratio size = root(Ratio(n[i] * n[i], dot(n, n)));
    const bool negative = n[i].sign() * -t.orientation * handedness == Sign::negative;
    shares.normal.add(normal[i], negative ? Ratio() - size : size);
  }
}

template <class Arithmetic>
Shares shares_of(bool perspective, std::uint64_t seed) {
  Numbers n(seed);
  Shares shares;
  for (int i = 0; i < 120 / checks::effort + 10; ++i) {
    const Camera camera = camera_from(n, perspective);
    Scene scene = checks::scene_of({}, {});
    scene.objects[0] = object_from(n);
    const SceneRays rays(scene, camera);
    const ObjectRays& object = rays.object(0);
    EXPECT_TRUE(object.usable && rays.world().usable);
    const Sign handedness = Dyadic(camera.projection.fx * camera.projection.fy).sign() *
                            determinant_of_rotation(camera.world_to_camera).sign();
    for (int k = 0; k < 12; ++k) {
      const MeshTriangle corners = corners_from(n);
      Mesh mesh;
      mesh.vertices.assign(corners.begin(), corners.end());
      mesh.triangles = {{0, 1, 2}};
      TierCounts counts;
      const ProjectedTriangle t =
          project(world_corners(scene.objects[0], mesh, 0), 0, camera, counts);
      for (int j = 0; j < 12; ++j) {
        const ImagePoint s{n.below(200) + 0.5, n.below(150) + 0.5};
        const ImagePoint point{s.u, s.v};
        if (!covers(t, point, counts) || depth_at(t, point).sign() != Sign::positive) continue;
        add_shares<Arithmetic>({corners, object, rays, {perspective, 200, 150}, s}, t, handedness,
                               shares);
      }
    }
  }
  EXPECT_GT(shares.depth.count(), 300 / checks::effort);
  return shares;
}

/// No error exceeds its bound; the greatest reaches these shares of it.
struct Tightness {
  double varying, constant, edges, depth, distance, position, weights, normal;
  double mesh_normal, placed_normal, length, turn, ray_length;
};

void expect_tight(const Shares& shares, const Tightness& least, bool perspective) {
  if (checks::effort > 1) return;
  EXPECT_GT(shares.varying.publish("varying"), least.varying);
  EXPECT_GT(shares.constant.publish("constant"), least.constant);
  EXPECT_GT(shares.edges.publish("edges"), least.edges);
  EXPECT_GT(shares.depth.publish("depth"), least.depth);
  if (perspective) {
    EXPECT_GT(shares.distance.publish("distance"), least.distance);
    EXPECT_GT(shares.ray_length.publish("ray_length"), least.ray_length);
  }
  EXPECT_GT(shares.position.publish("position"), least.position);
  EXPECT_GT(shares.weights.publish("weights"), least.weights);
  EXPECT_GT(shares.normal.publish("normal"), least.normal);
  EXPECT_GT(shares.mesh_normal.publish("mesh_normal"), least.mesh_normal);
  EXPECT_GT(shares.placed_normal.publish("placed_normal"), least.placed_normal);
  EXPECT_GT(shares.length.publish("length"), least.length);
  EXPECT_GT(shares.turn.publish("turn"), least.turn);
}

/// ε is 16u², while an operation mostly errs by less than u²: the bounds are loose by design here,
/// eight bits of the forty that are to spare. The products of n itself are often exact.
constexpr Tightness double_words{0.0018, 0.004, 0.002, 0.002, 0.001,  0.0015, 0.0018,
                                 0.006,  -1,    0.006, 0.004, 0.0014, 0.0018};

class ChannelBounds : public ::testing::TestWithParam<bool> {};

TEST_P(ChannelBounds, HoldInBinary64) {
  const Tightness least{0.06, 0.12, 0.035, 0.04, 0.03, 0.03, 0.03,
                        0.08, 0.25, 0.2,   0.1,  0.04, 0.03};
  expect_tight(shares_of<Binary64>(GetParam(), 41), least, GetParam());
}
TEST_P(ChannelBounds, HoldInDoubleWordsWithFma) {
  expect_tight(shares_of<Wide<wide_with_fma>>(GetParam(), 42), double_words, GetParam());
}
TEST_P(ChannelBounds, HoldInDoubleWordsWithoutFma) {
  expect_tight(shares_of<Wide<wide_without_fma>>(GetParam(), 43), double_words, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Fast, ChannelBounds, ::testing::Bool());

}  // namespace
}  // namespace fathom
