// The bounds of the fast engine from both sides: never violated against exact values, and not
// looser than a stated factor.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/fast/setup.h"
#include "fathom/fast/vertex.h"
#include "fathom/numeric/rounding.h"
#include "tests/exact/scene_building.h"

namespace fathom {
namespace {

/// |computed − exact| / bound, exact until it is rounded for the eye.
double used_share(double computed, const Ratio& exact, double bound) {
  const Ratio error = Ratio(Dyadic(computed)) - exact;
  return std::abs(round_to_binary64(error * Ratio(1.0, Dyadic(bound))));
}

/// Collects shares: none may exceed 1, and the greatest says how tight the bound is.
class Share {
 public:
  void add(double share) {
    EXPECT_LE(share, 1);
    greatest_ = std::max(greatest_, share);
    ++count_;
  }
  [[nodiscard]] double greatest() const { return greatest_; }
  [[nodiscard]] int count() const { return count_; }

 private:
  double greatest_ = 0;
  int count_ = 0;
};

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  /// Uniform in (−1, 1), all 53 bits used.
  double unit() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
  /// A magnitude from all over, some of few bits, some 0, some near a power of two.
  double wild(int exponents) {
    const double size = std::ldexp(1, below(2 * exponents + 1) - exponents);
    switch (below(5)) {
      case 0:
        return 0;
      case 1:
        return (below(17) - 8) * size;
      case 2:
        return std::nextafter(size, 0) * (below(2) ? 1 : -1);
      default:
        return unit() * size;
    }
  }

 private:
  std::mt19937_64 random_;
};

Camera camera_from(Numbers& n, bool perspective) {
  Camera c = testing::camera_of(1000, 800, 0);
  c.projection = perspective ? Projection::perspective : Projection::orthographic;
  do {
    c.fx = 700 * (1 + n.unit() / 2);
    c.fy = (n.below(2) ? 1 : -1) * 700 * (1 + n.unit() / 2);
    c.skew = n.below(2) ? n.unit() : 0;
    c.cx = 500 + n.unit();
    for (auto& row : c.world_to_camera) {
      for (double& entry : row) entry = n.below(6) == 0 ? n.wild(20) : n.unit();
    }
    c.world_to_camera[2][3] = n.below(3) == 0 ? n.unit() : 4 + n.unit();
  } while (find_fault(c));
  return c;
}

/// A placed object: its matrix has entries of more than 53 bits once multiplied with the camera's.
Object object_from(Numbers& n) {
  Object object;
  if (n.below(2)) return object;
  object.placed_as_is = false;
  for (auto& row : object.world_from_mesh.rows) {
    for (Dyadic& entry : row) entry = Dyadic(n.unit());
  }
  return object;
}

struct Exact {
  HomogeneousImagePoint image;
  Dyadic D;
};
Exact exact_image(const Object& object, const Camera& camera, const MeshPoint& X) {
  const CameraPoint p = to_camera(camera, object.world_from_mesh(X));
  return {to_image(camera, p), p.z};
}

class Vertices : public ::testing::TestWithParam<bool> {};

TEST_P(Vertices, BoundsHoldAndAreTight) {
  const bool perspective = GetParam();
  Numbers n(perspective ? 11 : 12);
  Share u, v, q;
  int unusable = 0, behind = 0;
  for (int i = 0; i < 1500; ++i) {
    const Camera camera = camera_from(n, perspective);
    const Object object = object_from(n);
    const VertexTransform transform(object, camera);
    for (int k = 0; k < 20; ++k) {
      const MeshPoint X = n.below(2) ? MeshPoint{n.wild(40), n.wild(40), n.wild(40)}
                                     : MeshPoint{n.unit(), n.unit(), n.unit()};
      const ImageVertex vertex = transform(X);
      const Exact exact = exact_image(object, camera, X);
      if (!vertex.is_usable()) {
        ++unusable;
        behind += vertex.is_behind();
        if (vertex.is_behind()) {
          EXPECT_NE(exact.image.W.sign(), Sign::positive);
        }
        continue;
      }
      ASSERT_EQ(exact.image.W.sign(), Sign::positive);
      u.add(used_share(vertex.u, {exact.image.U, exact.image.W}, vertex.position_error()));
      v.add(used_share(vertex.v, {exact.image.V, exact.image.W}, vertex.position_error()));
      q.add(used_share(vertex.q, perspective ? Ratio(1.0, exact.D) : Ratio(-exact.D),
                       vertex.q_error()));
    }
  }
  EXPECT_GT(u.count(), 5000);
  EXPECT_GT(unusable, 500);
  if (perspective) {
    EXPECT_GT(behind, 500);
  }
  // Not looser than this factor: the greatest errors found reach these shares of their bounds.
  EXPECT_GT(u.greatest(), 0.25);
  EXPECT_GT(v.greatest(), 0.25);
  EXPECT_GT(q.greatest(), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Fast, Vertices, ::testing::Bool());

TEST(Fast, VerticesOfMagnitudesBeyondTheBoundsAreNotUsable) {
  const Camera camera = testing::camera_of(100, 100, 50);
  const VertexTransform transform(Object{}, camera);
  EXPECT_TRUE(transform({1, 1, 1}).is_usable());
  for (const MeshPoint& X : {MeshPoint{1, 1, 0x1p-61}, MeshPoint{1, 1, 0x1p61},
                             MeshPoint{1e300, 1, 1}, MeshPoint{1e308, 1e308, 1e308},
                             MeshPoint{1, 1, 0}, MeshPoint{1, 1, -1}, MeshPoint{1e8, 1, 1}}) {
    EXPECT_FALSE(transform(X).is_usable()) << X.x << " " << X.y << " " << X.z;
  }
  EXPECT_TRUE(transform({1, 1, -1}).is_behind());
  EXPECT_FALSE(transform({1, 1, 0}).is_behind());
  Camera vast = camera;
  vast.fx = 1e250;
  EXPECT_FALSE(VertexTransform(Object{}, vast)({1, 1, 1}).is_usable());
}

/// Triangles near the image: of all sizes, many of them thin.
std::array<MeshPoint, 3> triangle_from(Numbers& n) {
  const MeshPoint A{n.unit() * 2, n.unit() * 2, 1 + n.unit() / 2};
  const double size = std::ldexp(1, -n.below(12));
  const auto near = [&](const MeshPoint& p, double s) {
    return MeshPoint{p.x + n.unit() * s, p.y + n.unit() * s, p.z + n.unit() * s / 4};
  };
  MeshPoint B = near(A, size), C = near(A, size);
  if (n.below(3) == 0) {  // thin: C near the line AB
    const double t = n.unit() * 2;
    const double off = size * std::ldexp(1, -n.below(40));
    C = near({A.x + t * (B.x - A.x), A.y + t * (B.y - A.y), A.z + t * (B.z - A.z)}, off);
  }
  return {A, B, C};
}

struct Triangle {
  ProjectedTriangle exact;
  std::array<ImageVertex, 3> vertices;
};

Triangle project_both(const std::array<MeshPoint, 3>& corners, const Camera& camera) {
  Triangle t;
  std::array<WorldPoint, 3> world;
  const VertexTransform transform(Object{}, camera);
  for (std::size_t i = 0; i < 3; ++i) {
    world[i] = WorldFromMesh{}(corners[i]);
    t.vertices[i] = transform(corners[i]);
  }
  TierCounts counts;
  t.exact = project(world, 0, camera, counts);
  return t;
}

Camera plain_camera(bool perspective) {
  Camera camera = testing::camera_of(640, 480, 301.7);
  camera.cx = 320.3;
  camera.skew = 0.3;
  if (!perspective) camera.projection = Projection::orthographic;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.03}, {0.05, 1.1, 0.3, -0.1}, {0.2, -0.3, 0.8, 3}}};
  return camera;
}

double edge_at(const TriangleSetup& s, std::size_t i, double x, double y) {
  return (s.edge_c[i] + s.edge_b[i] * y) + s.edge_a[i] * x;
}
double q_at(const TriangleSetup& s, double x, double y) {
  return (s.q_c + s.q_b * y) + s.q_a * x;
}

Ratio exact_q(const ProjectedTriangle& t, const ImagePoint& s, bool perspective) {
  const Ratio D = depth_at(t, s);
  return perspective ? Ratio(D.denominator, D.numerator) : Ratio(-D.numerator, D.denominator);
}

/// A sample of the box: a corner of it, or any.
ImagePoint sample_of(Numbers& n, const PixelBox& box) {
  const auto pick = [&](std::uint32_t first, std::uint32_t last) {
    const int choice = n.below(4);
    if (choice == 0) return first;
    if (choice == 1) return last;
    return first + static_cast<std::uint32_t>(n.below(static_cast<int>(last - first + 1)));
  };
  return {pick(box.first_column, box.last_column) + 0.5, pick(box.first_row, box.last_row) + 0.5};
}

struct SetupShares {
  Share edges, q;
  int setups = 0, refused = 0;
};

void check_certified(const Triangle& t, const Camera& camera, Numbers& n, SetupShares& shares) {
  const bool perspective = camera.projection == Projection::perspective;
  constexpr CornerIndices corners{0, 1, 2};
  const auto orientation = certified_orientation(t.vertices.data(), corners);
  if (orientation) {
    EXPECT_EQ(*orientation, t.exact.orientation);
  }
  const PixelBox image{0, camera.width - 1, 0, camera.height - 1};
  SetupBatch batch;
  certified_setups(t.vertices.data(), &corners, 1, image, depth_range(camera), batch);
  if ((batch.empty & 1) || !orientation || *orientation == Sign::zero) return;
  if (batch.refused & 1) {
    ++shares.refused;
    return;
  }
  const PixelBox box = batch.box(0);
  const TriangleSetup setup = batch.get(0);
  ++shares.setups;
  // The setup turns the triangle so that its inside is positive, by exchanging B and C.
  const bool turned = t.exact.orientation == Sign::negative;
  const std::size_t order[] = {0, turned ? 2U : 1U, turned ? 1U : 2U};
  std::array<Dyadic, 3> W;
  for (std::size_t i = 0; i < 3; ++i) W[i] = to_image(camera, t.exact.camera[i]).W;
  for (int k = 0; k < 6; ++k) {
    const ImagePoint s = sample_of(n, box);
    const double x = s.u - 0.5 - setup.column, y = s.v - 0.5 - setup.row;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = order[i];
      const Ratio exact(t.exact.edges[corner].at(s.u, s.v),
                        W[(corner + 1) % 3] * W[(corner + 2) % 3]);
      shares.edges.add(used_share(edge_at(setup, i, x, y), exact, setup.edge_error));
    }
    TierCounts counts;
    if (covers(t.exact, s, counts)) {
      shares.q.add(used_share(q_at(setup, x, y), exact_q(t.exact, s, perspective),
                              setup.q_error * (1 - 0x1p-20)));
    }
  }
}

class Setups : public ::testing::TestWithParam<bool> {};

TEST_P(Setups, FromVerticesBoundsHoldAndAreTight) {
  const Camera camera = plain_camera(GetParam());
  Numbers n(21);
  SetupShares shares;
  for (int i = 0; i < 20000; ++i) {
    check_certified(project_both(triangle_from(n), camera), camera, n, shares);
  }
  EXPECT_GT(shares.setups, 3000);
  EXPECT_GT(shares.refused, 20);
  EXPECT_GT(shares.edges.count(), 20000);
  EXPECT_GT(shares.q.count(), 2500);
  EXPECT_GT(shares.edges.greatest(), 0.02);
  EXPECT_GT(shares.q.greatest(), 0.02);
}

/// Corners given directly, their errors as large as their bounds allow: the exact corners are the
/// computed ones moved by the bound in the worst direction.
TEST_P(Setups, FromVerticesBoundsHoldForTheWorstErrorsOfCorners) {
  Camera camera = testing::camera_of(64, 64, 1);  // u = x/z or x
  camera.cx = camera.cy = 0;
  const bool perspective = GetParam();
  if (!perspective) camera.projection = Projection::orthographic;
  Numbers n(22);
  SetupShares shares;
  for (int i = 0; i < 20000; ++i) {
    const double e = std::ldexp(1, -13 - n.below(12));
    Triangle t;
    std::array<WorldPoint, 3> world;
    const int size = 1 << n.below(7);
    for (std::size_t k = 0; k < 3; ++k) {
      const double q = perspective ? std::ldexp(1, -n.below(4)) : n.below(9) - 4.0;
      const double u = n.below(size + 1) + n.below(2) * 0.5, v = n.below(size + 1);
      t.vertices[k] = {u, v, q, upper_half(e) << 32 | upper_half(e * 0x1p-10)};
      const Dyadic exact_u = Dyadic(u) + Dyadic((n.below(2) * 2 - 1) * e);
      const Dyadic exact_v = Dyadic(v) + Dyadic((n.below(2) * 2 - 1) * e);
      const Dyadic D = perspective ? Dyadic(1 / q) : Dyadic(-q);
      world[k] =
          perspective ? WorldPoint{exact_u * D, exact_v * D, D} : WorldPoint{exact_u, exact_v, D};
    }
    TierCounts counts;
    t.exact = project(world, 0, camera, counts);
    check_certified(t, camera, n, shares);
  }
  EXPECT_GT(shares.setups, 3000);
  EXPECT_GT(shares.q.count(), 3000);
  EXPECT_GT(shares.edges.greatest(), 0.2);
  EXPECT_GT(shares.q.greatest(), 0.03);
}

TEST_P(Setups, FromExactFormsBoundsHoldAndAreTight) {
  const bool perspective = GetParam();
  const Camera camera = plain_camera(perspective);
  Numbers n(23);
  Share edges, q;
  for (int i = 0; i < 6000; ++i) {
    auto corners = triangle_from(n);
    if (n.below(2)) corners[0].z -= 5;  // reaches behind the camera
    const Triangle t = project_both(corners, camera);
    if (t.exact.orientation == Sign::zero) continue;
    const auto column = static_cast<std::uint32_t>(n.below(576));
    const auto row = static_cast<std::uint32_t>(n.below(416));
    const PixelBox box{column, column + 63, row, row + 63};
    const TriangleSetup setup = exact_setup(t.exact, perspective, box);
    for (int k = 0; k < 4; ++k) {
      const ImagePoint s = sample_of(n, box);
      const double x = s.u - 0.5 - column, y = s.v - 0.5 - row;
      for (std::size_t j = 0; j < 3; ++j) {
        // The scale is a power of two: that between a coefficient and its exact value.
        const ExactVector3& l = t.exact.edges[j].coefficients();
        const bool use_a = !l[0].is_zero();
        const double exact_size = round_to_binary64(Ratio(use_a ? l[0] : l[1]));
        const double size = use_a ? setup.edge_a[j] : setup.edge_b[j];
        const long scale = std::ilogb(size) - std::ilogb(exact_size);
        edges.add(used_share(edge_at(setup, j, x, y),
                             Ratio(t.exact.edges[j].at(s.u, s.v).scaled(scale)), setup.edge_error));
      }
      const Ratio w(t.exact.weight.at(s.u, s.v));
      if (perspective && w.sign() != Sign::positive) continue;
      const Ratio exact = perspective ? Ratio(w.numerator, t.exact.depth_numerator.at(s.u, s.v))
                                      : exact_q(t.exact, s, perspective);
      q.add(used_share(q_at(setup, x, y), exact, setup.q_error * (1 - 0x1p-20)));
    }
  }
  EXPECT_GT(q.count(), 5000);
  EXPECT_GT(edges.greatest(), 0.1);
  EXPECT_GT(q.greatest(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Fast, Setups, ::testing::Bool());

}  // namespace
}  // namespace fathom
