#include "validation/lenses/lens_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fathom/lens/preimages.h"
#include "fathom/rays/cast.h"
#include "validation/lenses/lens_cases.h"
#include "validation/scenes/shapes.h"
#include "validation/scenes/validation_scenes.h"

namespace fathom::validation {
namespace {

using attribution::PixelClass;
using lens::ExactDirection;

constexpr std::uint32_t columns = 48, rows = 36;

LensCase case_of(const std::string& scene, const Camera& lens) {
  return lens_case(make_validation_scene(scene, lens.width, lens.height), lens);
}

Camera lens_named(const std::string& name) {
  const std::vector<Camera> all = lens_cameras(columns, rows);
  return *std::ranges::find(all, name, &Camera::name);
}

/// The exact answers to the rays, t in binary32: what a perfect engine reports.
EngineAnswers perfect_answers(const LensCase& given, const RoundedRays& rays) {
  EngineAnswers answers{.nearest = cast(RayScene(given.world), rays.rays)};
  for (RayHit& hit : answers.nearest) hit.t = static_cast<float>(hit.t);
  return answers;
}

std::size_t surfaces(const LensCase& given) {
  return static_cast<std::size_t>(std::ranges::count_if(
      given.truth.triangles, [](std::uint32_t triangle) { return triangle != no_surface; }));
}

TEST(LensJudge, ExplainsPerfectAnswersThroughEveryLens) {
  for (const Camera& lens : lens_cameras(columns, rows)) {
    for (const char* scene : {"spot", "slivers"}) {
      const LensCase given = case_of(scene, lens);
      const LensJudge judge(given);
      const JudgedLens judged = judge.judge(perfect_answers(given, judge.rays()));
      EXPECT_EQ(judged.unexplained(), 0U) << lens.name << ' ' << scene;
      EXPECT_EQ(judged.missed, 0U);
      if (scene == std::string("slivers")) {
        EXPECT_GT(surfaces(given), 20U) << lens.name;
      }
      // Only rounded rays show another triangle.
      EXPECT_EQ(judged.by_rounded_rays, judged.attribution.count(PixelClass::edge) +
                                            judged.attribution.count(PixelClass::z_fight) +
                                            judged.attribution.count(PixelClass::missed));
      EXPECT_LT(judged.attribution.sharpness.median_relative_width, 1e-5);
    }
  }
}

/// Every pixel that shows a surface is unexplained, whatever is wrong with it.
TEST(LensJudge, LeavesWrongAnswersUnexplained) {
  for (const Camera& lens : lens_cameras(columns, rows)) {
    const LensCase given = case_of("slivers", lens);
    const LensJudge judge(given);
    const EngineAnswers right = perfect_answers(given, judge.rays());
    const auto unexplained = [&](auto change) {
      EngineAnswers answers = right;
      for (RayHit& hit : answers.nearest)
        if (hit.triangle != no_triangle) change(hit);
      return judge.judge(answers).unexplained();
    };
    const std::size_t shown = surfaces(given);
    EXPECT_GT(unexplained([](RayHit& hit) { hit.t *= 1 + 1e-4; }), shown * 8 / 10) << lens.name;
    EXPECT_GT(unexplained([](RayHit& hit) { hit.triangle ^= 1; }), shown * 8 / 10) << lens.name;
    EXPECT_GT(unexplained([](RayHit& hit) { hit = {}; }), shown * 8 / 10) << lens.name;
  }
}

TEST(LensJudge, LeavesAMapOfAnotherLensUnexplained) {
  const Camera lens = lens_named("EUCM");
  const LensCase given = case_of("slivers", lens);
  const LensJudge judge(given);
  const std::size_t shown = surfaces(given);
  for (const double alpha : {0.62, 0.625}) {
    Camera other = lens;
    other.projection.lens->distortion[0] = alpha;
    const RoundedRays others = rounded_rays(other);
    ASSERT_EQ(others.pixels, judge.rays().pixels);
    const std::size_t unexplained = judge.judge(perfect_answers(given, others)).unexplained();
    if (alpha == 0.62) {
      EXPECT_EQ(unexplained, 0U);
    } else {
      EXPECT_GT(unexplained, shown / 2);
    }
  }
}

/// A triangle in the plane z = q whose right edge lies at x/z = p/q, between 0.1 and the binary32
/// number next to it, and a pixel that looks to x/z = 0.1.
LensCase edge_between_ray_and_rounded_ray() {
  const float p = 0x0.fffffdp0F, q = 0xa.000000p0F - 0x2p-20F;
  Mesh mesh;
  mesh.vertices = {{p, -q, q}, {p, q, q}, {-q, 0, q}};
  mesh.triangles = {{0, 1, 2}};
  Camera table{.width = 1, .height = 1};
  Lens lens{.model = LensModel::table};
  lens.directions = std::make_shared<DirectionTable>(1, 1, std::vector<double>{0.1, 0.05, 1});
  table.projection.lens = lens;
  return lens_case({"edge", bench::as_scene({mesh}, "edge"), Camera{.width = 1, .height = 1}},
                   table);
}

TEST(LensJudge, TellsTheRoundingOfTheRayFromTheEnginesArithmetic) {
  const LensCase given = edge_between_ray_and_rounded_ray();
  ASSERT_EQ(given.truth.triangles.at(0), 0U);
  const LensJudge judge(given);
  const EngineAnswers exact = perfect_answers(given, judge.rays());
  ASSERT_EQ(exact.nearest.at(0).triangle, no_triangle);
  const JudgedLens by_ray = judge.judge(exact);
  EXPECT_EQ(by_ray.unexplained(), 0U);
  EXPECT_EQ(by_ray.by_rounded_rays, 1U);
  // An engine may as well hit the triangle, which is nearer than its arithmetic resolves.
  const JudgedLens hit = judge.judge({.nearest = {{0, given.world.meshes[0].vertices[0].z}}});
  EXPECT_EQ(hit.unexplained(), 0U);
  EXPECT_EQ(hit.by_rounded_rays, 0U);
}

/// −1, 0 or 1: the sign of d_k − m·s·d_g.
int sign_of(const ExactDirection& d, std::size_t k, double m, double s, std::size_t g) {
  ExactVector3 form;
  form[k] = 1.0;
  form[g] = form[g] - Dyadic(m) * Dyadic(s);
  return static_cast<int>(d.sign_of(form));
}

/// Halfway to the next binary32 number in a direction, exactly.
double halfway(double x, float towards) {
  const auto y = static_cast<float>(x);
  return (double{y} + double{std::nextafter(y, towards)}) / 2;
}

/// The rays of the engines against the directions of the specification, by exact signs.
TEST(RoundedRays, AreTheNearestInBinary32) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const Camera& lens : lens_cameras(14, 10)) {
    const lens::Preimages preimages(lens.projection, *lens.projection.lens);
    const RoundedRays made = rounded_rays(lens);
    std::size_t next = 0;
    for (std::uint32_t pixel = 0; pixel < 14 * 10; ++pixel) {
      const auto d = preimages.of_pixel(pixel % 14, pixel / 14);
      const bool has_ray = next < made.pixels.size() && made.pixels[next] == pixel;
      ASSERT_EQ(has_ray, d.has_value()) << lens.name << ' ' << pixel;
      if (!d) continue;
      const auto& r = made.rays[next++].direction;
      const auto g = static_cast<std::size_t>(
          std::ranges::max_element(r, {}, [](double x) { return std::abs(x); }) - r.begin());
      ASSERT_EQ(std::abs(r[g]), 1);
      for (std::size_t k = 0; k < 3; ++k) {
        if (k == g) continue;
        EXPECT_LE(sign_of(*d, k, halfway(r[k], infinity), r[g], g), 0) << lens.name << ' ' << pixel;
        EXPECT_GE(sign_of(*d, k, halfway(r[k], -infinity), r[g], g), 0) << lens.name;
      }
    }
    EXPECT_EQ(next, made.rays.size());
  }
}

}  // namespace
}  // namespace fathom::validation
