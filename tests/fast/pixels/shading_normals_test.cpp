// Shading normals in binary64 against exact numbers: no error exceeds its bound.
#include "fathom/fast/pixels/shading_normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/effort.h"
#include "tests/inputs/scene_building.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;
using checks::Numbers;

/// A mesh of 30 triangles between 12 vertices, of which some are at places of others, times `size`;
/// a third of them lie in planes z = 1/2, so that components of sums cancel.
Scene random_scene(Numbers& n, double size, bool placed) {
  std::vector<MeshPoint> vertices;
  for (int i = 0; i < 12; ++i) {
    if (i > 8) {
      vertices.push_back(vertices[static_cast<std::size_t>(n.below(8))]);
    } else {
      const double z = i % 3 == 0 ? 0.5 : n.unit();
      vertices.push_back({n.unit() * size, n.unit() * size, z * size});
    }
  }
  std::vector<CornerIndices> triangles;
  const auto corner = [&] { return static_cast<std::uint32_t>(n.below(12)); };
  for (int i = 0; i < 30; ++i) triangles.push_back({corner(), corner(), corner()});
  Scene scene = checks::scene_of(vertices, triangles);
  if (!placed) return scene;
  Object& object = scene.objects[0];
  object.placed_as_is = false;
  for (auto& row : object.world_from_mesh.rows) {
    for (Dyadic& entry : row) entry = n.below(3) == 0 ? Dyadic() : Dyadic(n.unit());
  }
  return scene;
}

void expect_within(const Certified<double>& x, const Dyadic& exact, int& known) {
  if (!std::isfinite(x.error)) return;
  ++known;
  EXPECT_LE(abs(Dyadic(x.value) - exact), Dyadic(x.error)) << x.value << " ± " << x.error;
}

/// Whether a·√square ≤ b.
bool is_root_at_most(const Dyadic& a, const Dyadic& square, const Dyadic& b) {
  const Dyadic left = a * a * square, right = b * b;
  if (a.sign() == Sign::negative) return b.sign() != Sign::negative || left >= right;
  return b.sign() != Sign::negative && left <= right;
}

void expect_unit(const Vector<Certified<double>>& found, const ExactVector3& m, int& known) {
  const Dyadic square = dot(m, m);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [value, error] = found[i];
    if (!std::isfinite(error)) continue;
    ++known;
    EXPECT_TRUE(is_root_at_most(Dyadic(value) - Dyadic(error), square, m[i])) << value;
    EXPECT_TRUE(is_root_at_most(Dyadic(-value) - Dyadic(error), square, -m[i])) << value;
  }
}

void check(const Scene& scene, NormalSource source, Numbers& n, int& known_corners,
           int& known_units) {
  const TriangleSource triangles(scene);
  const Camera camera = checks::camera_of(10, 10, 10);
  const SceneRays rays(triangles, camera);
  const ValueFrame frame(rays);
  const auto corners = std::make_shared<const CornerNormals>(triangles, source);
  ShadingNormals narrow(corners);
  ExactCornerNormals wide(corners);
  for (std::uint32_t t = 0; t < triangles.count(); ++t) {
    const SurfaceFacts facts = surface_facts(t, frame);
    if (!facts.usable) continue;
    const SurfaceNormals found = narrow.of_surface(t, facts);
    const std::array<ExactVector3, 3> exact = wide.of_triangle(t);
    const double u = std::abs(n.unit()), b = u * 0.75, c = (1 - u) * 0.5;
    ExactVector3 m;
    for (std::size_t i = 0; i < 3; ++i) {
      expect_within(found.at_A[i], exact[0][i], known_corners);
      expect_within(found.to_B[i], exact[1][i] - exact[0][i], known_corners);
      expect_within(found.to_C[i], exact[2][i] - exact[0][i], known_corners);
      m[i] = exact[0][i] + Dyadic(b) * (exact[1][i] - exact[0][i]) +
             Dyadic(c) * (exact[2][i] - exact[0][i]);
      if (std::isfinite(found.at_A[i].error)) {
        EXPECT_EQ(found.at_A[i].value == 0, exact[0][i].is_zero());
        EXPECT_LE(found.at_A[i].error, std::abs(found.at_A[i].value) * 0x1p-40);
      }
    }
    expect_unit(unit(interpolated(found, {Certified<double>{b, 0}, {c, 0}})), m, known_units);
  }
}

TEST(ShadingNormals, NoErrorExceedsItsBound) {
  Numbers n(77);
  int known_corners = 0, known_units = 0;
  for (int i = 0; i < 1500 / checks::effort && !HasFailure(); ++i) {
    const double size = std::ldexp(1, static_cast<int>(n.below(9)) * 20 - 80);
    Scene scene = random_scene(n, size, i % 2 == 1);
    Mesh& mesh = scene.meshes[0];
    if (i % 3 == 0) {
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const double scale = std::ldexp(1, static_cast<int>(n.below(3)) * 500 - 500);
        mesh.normals.push_back({n.unit() * scale, 0, n.unit() * scale});
      }
    }
    check(scene, i % 5 == 0 ? NormalSource::place : NormalSource::file, n, known_corners,
          known_units);
  }
  EXPECT_GT(known_corners, 100000 / checks::effort);
  EXPECT_GT(known_units, 30000 / checks::effort);
}

}  // namespace
}  // namespace fathom
