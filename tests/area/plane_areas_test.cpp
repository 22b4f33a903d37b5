// Areas by parts, sheets and sweeps against areas triangle by triangle, in all bits.
#include "fathom/area/plane/plane_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "tests/adversaries.h"
#include "tests/area/crowds.h"
#include "tests/area/pairwise_areas.h"
#include "tests/area/surfaces.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/spheres.h"

namespace fathom {
namespace {

using namespace area;
using checks::Case;

void expect_same(const VisibleArea& found, const VisibleArea& expected) {
  EXPECT_EQ(found.visible, expected.visible);
  EXPECT_EQ(found.unoccluded, expected.unoccluded);
  EXPECT_EQ(found.ratio, expected.ratio);
}

void expect_as_pairwise(const Scene& scene, const Camera& camera, Cull cull = Cull::none) {
  RenderOptions options;
  options.cull = cull;
  options.threads = 1;
  const VisibleAreas found = visible_areas(scene, camera, options);
  const VisibleAreas expected = checks::rounded_pairwise_areas(scene, camera, cull);
  ASSERT_EQ(found.triangles.size(), expected.triangles.size());
  for (std::size_t t = 0; t < found.triangles.size(); ++t) {
    SCOPED_TRACE("triangle " + std::to_string(t));
    expect_same(found.triangles[t], expected.triangles[t]);
  }
  ASSERT_EQ(found.objects.size(), expected.objects.size());
  for (std::size_t object = 0; object < found.objects.size(); ++object) {
    SCOPED_TRACE("object " + std::to_string(object));
    expect_same(found.objects[object], expected.objects[object]);
  }
}

TEST(PlaneAreasAdversaries, AreThoseOfPairs) {
  for (const checks::Family family : checks::all_families) {
    SCOPED_TRACE(name_of(family));
    checks::for_each_adversary(60, [&](std::uint64_t seed) {
      const Case c = checks::adversarial_case(family, seed);
      expect_as_pairwise(c.scene, c.camera, static_cast<Cull>(seed % 3));
    });
  }
}

TEST(PlaneAreas, OfRandomScenesAreThoseOfPairs) {
  for (const checks::Kind kind :
       {checks::Kind::few_bits, checks::Kind::neighbours, checks::Kind::huge, checks::Kind::tiny}) {
    checks::CaseMaker maker(417 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 200 / checks::effort && !HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Case c = maker.make();
      expect_as_pairwise(c.scene, c.camera);
    }
  }
}

TEST(PlaneAreas, OfCrowdsAreThoseOfPairs) {
  for (const int scale : {1, 6}) {
    for (const checks::Crowd& crowd : checks::crowds(scale)) {
      SCOPED_TRACE(crowd.name);
      expect_as_pairwise(crowd.scene, checks::plain_camera(1, 1));
      expect_as_pairwise(crowd.scene, checks::plain_camera(3, 2), Cull::back);
    }
  }
}

TEST(PlaneAreas, OfSoupsAreThoseOfPairs) {
  std::mt19937_64 random(20);
  for (int i = 0; i < 6 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = checks::soup(random, 60 + 40 * i, i % 2 == 0);
    expect_as_pairwise(scene, checks::camera_of(160, 140, 64));
  }
}

Camera in_front_of_spheres() {
  Camera camera = checks::camera_of(60, 50, 40);
  camera.world_to_camera = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 4}}};
  return camera;
}

TEST(PlaneAreas, OfSpheresThatPenetrateEachOtherAreThoseOfPairs) {
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    expect_as_pairwise(checks::two_spheres(12), in_front_of_spheres(), cull);
  }
  Camera inside = checks::camera_of(60, 50, 20);
  inside.world_to_camera = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0.25}}};
  inside.near = 0.125;
  expect_as_pairwise(checks::two_spheres(12), inside);
}

/// A fan that winds twice around a point of the image is one sheet, which covers each part twice:
/// half of it is hidden.
TEST(PlaneAreas, OfASheetThatWindsTwiceAreThoseOfPairs) {
  constexpr std::uint32_t triangles = 10;
  std::vector<MeshPoint> vertices{{2.125, 2.25, 5}};
  std::vector<CornerIndices> fan;
  for (std::uint32_t k = 0; k < triangles; ++k) {
    const double turn = 4 * std::numbers::pi * k / triangles;
    vertices.push_back(
        {2.125 + 9 * std::cos(turn), 2.25 + 9 * std::sin(turn), 5 + 2 * std::sin(turn / 2 + 0.3)});
    fan.push_back({0, k + 1, (k + 1) % triangles + 1});
  }
  const Scene scene = checks::scene_of(vertices, fan);
  const Camera camera = checks::plain_camera(4, 4);
  expect_as_pairwise(scene, camera);
  const VisibleAreas found = visible_areas(scene, camera, {});
  EXPECT_EQ(found.objects[0].visible, 16);
  double all = 0;
  for (const VisibleArea& area : found.triangles) all += area.unoccluded;
  EXPECT_NEAR(all, 32, 1e-12);
}

/// A scene's mesh on the image.
struct MeshOnImage {
  TriangleSource triangles;
  std::function<void(double)> no_report;
  Progress progress{no_report, 1};
  ProjectedScene projected;
  PlaneMesh mesh;

  MeshOnImage(const Scene& scene, const Camera& camera)
      : triangles(scene),
        projected({triangles, camera}, progress),
        mesh(projected, numbers_of(projected)) {}
  static std::vector<std::uint32_t> numbers_of(const ProjectedScene& scene) {
    std::vector<std::uint32_t> numbers(scene.count());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }
};

/// Counts the sums whose bounds are known and narrow.
void expect_contained(const Words& sum, const Terms& terms, int& narrow) {
  if (!std::isfinite(sum.error)) return;
  const Ratio rest = Ratio(Dyadic(sum.value.hi) + Dyadic(sum.value.lo)) - sum_of(terms);
  EXPECT_LE(compare(Ratio(abs(rest.numerator), rest.denominator), Dyadic(sum.error)), 0);
  if (sum.error < 0x1p-70) ++narrow;
}

TEST(PlaneAreas, SumsContainTheExactSums) {
  int partly = 0, narrow = 0;
  for (const checks::Family family : checks::all_families) {
    SCOPED_TRACE(name_of(family));
    checks::for_each_adversary(20, [&](std::uint64_t seed) {
      const Case c = checks::adversarial_case(family, seed);
      const MeshOnImage image(c.scene, c.camera);
      const PlaneAreas exact(image.mesh, {.image = false, .share = true, .moments = true}),
          summed(image.mesh, {.image = false, .sums = true});
      for (std::uint32_t i = 0; i < image.mesh.size(); ++i) {
        ASSERT_EQ(summed.visibility(i), exact.visibility(i));
        if (exact.visibility(i) != Visibility::partly) continue;
        ++partly;
        EXPECT_TRUE(summed.terms(i).share.empty());
        expect_contained(summed.sums(i).share, exact.terms(i).share, narrow);
        expect_contained(summed.sums(i).beta, exact.terms(i).beta, narrow);
        expect_contained(summed.sums(i).gamma, exact.terms(i).gamma, narrow);
      }
    });
  }
  EXPECT_GT(narrow, partly);
}

TEST(PlaneAreas, TermsOfSomeTrianglesAreThoseOfAll) {
  constexpr WantedTerms on_surface{.image = false, .share = true, .moments = true};
  int partly = 0;
  checks::for_each_adversary(40, [&](std::uint64_t seed) {
    const Case c = checks::adversarial_case(checks::all_families[0], seed);
    const MeshOnImage image(c.scene, c.camera);
    const PlaneAreas all(image.mesh, on_surface);
    PlaneAreas some(image.mesh, {.image = false, .sums = true});
    std::vector<bool> is_wanted(image.mesh.size());
    for (std::size_t i = 0; i < is_wanted.size(); ++i) is_wanted[i] = (i + seed) % 3 == 0;
    some.find_terms(on_surface, is_wanted);
    for (std::uint32_t i = 0; i < image.mesh.size(); ++i) {
      if (!is_wanted[i]) {
        EXPECT_TRUE(some.terms(i).share.empty());
        continue;
      }
      partly += all.terms(i).share.empty() ? 0 : 1;
      EXPECT_EQ(sum_of(some.terms(i).share), sum_of(all.terms(i).share));
      EXPECT_EQ(sum_of(some.terms(i).beta), sum_of(all.terms(i).beta));
      EXPECT_EQ(sum_of(some.terms(i).gamma), sum_of(all.terms(i).gamma));
    }
  });
  EXPECT_GT(partly, 10);
}

/// Four triangles are one crowded part. The first hides a piece inside the third and all of the
/// fourth.
TEST(PlaneAreas, OfTrianglesThatNothingHidesTakeNoArithmetic) {
  const std::vector<MeshPoint> vertices{{0.5, 0.5, 1},   {1.5, 0.5, 1},   {0.5, 1.5, 1},
                                        {2.5, 2.5, 3},   {3.5, 2.5, 1},   {2.5, 3.5, 2},
                                        {0.25, 0.25, 2}, {2.25, 0.25, 2}, {0.25, 2.25, 2},
                                        {0.6, 0.6, 3},   {0.8, 0.6, 3},   {0.6, 0.8, 3}};
  const Scene scene = checks::scene_of(vertices, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  const MeshOnImage image(scene, checks::plain_camera(4, 4));
  for (const WantedTerms& wanted : {WantedTerms{}, WantedTerms{.image = false, .sums = true}}) {
    const PlaneAreas areas(image.mesh, wanted);
    ASSERT_EQ(areas.resolved().crowded.size(), 1);
    EXPECT_EQ(areas.visibility(0), Visibility::whole);
    EXPECT_EQ(areas.visibility(1), Visibility::whole);
    EXPECT_EQ(areas.visibility(2), Visibility::partly);
    EXPECT_EQ(areas.visibility(3), Visibility::partly);
    EXPECT_TRUE(areas.terms(0).image.empty());
    EXPECT_TRUE(areas.terms(3).image.empty());
  }
}

/// Of a closed surface without arithmetic: the far side is hidden by the near one, whose inner
/// triangles are visible as a whole.
TEST(PlaneAreas, MostOfASphereIsSettledByItsSheets) {
  Scene scene;
  scene.meshes.push_back(checks::sphere(60));
  scene.objects.push_back({.name = "sphere"});
  const Camera camera = in_front_of_spheres();
  const MeshOnImage image(scene, camera);
  const PlaneMesh& mesh = image.mesh;
  const PlaneAreas areas(mesh, {.image = true});
  std::size_t whole = 0, hidden = 0, pieces = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    whole += areas.visibility(i) == Visibility::whole;
    hidden += areas.visibility(i) == Visibility::hidden;
  }
  for (const CrowdedPart& part : areas.resolved().crowded) pieces += part.triangles.size();
  EXPECT_GT(whole, mesh.size() / 5);
  EXPECT_GT(hidden, mesh.size() / 3);
  EXPECT_LT(pieces, 2 * mesh.size());
  EXPECT_LT(areas.resolved().triangles_in_parts, 30 * mesh.size());
}

/// A grid of squares with gaps, of which cuts in the middle of parts meet many.
TEST(ResolvedParts, CutsThroughGapsMeetFewTriangles) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (int k = 0; k < 13 * 13; ++k) {
    const double u = 0.5 + k % 13, v = 0.5 + k / 13;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(),
                    {{u, v, 1}, {u + 0.75, v, 1}, {u + 0.75, v + 0.75, 1}, {u, v + 0.75, 1}});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  const Scene scene = checks::scene_of(vertices, triangles);
  const MeshOnImage image(scene, checks::plain_camera(14, 14));
  const auto pieces = [&](PartCuts cuts) {
    std::size_t count = 0;
    const ResolvedParts parts = resolve(image.mesh, image.projected.image(), cuts);
    for (const CrowdedPart& part : parts.crowded) count += part.triangles.size();
    return count;
  };
  EXPECT_LT(5 * pieces(PartCuts::through_few), 4 * pieces(PartCuts::in_middle));
}

}  // namespace
}  // namespace fathom
