// Maps of lenses against rays that are cast in rational numbers, every channel, over random scenes.
#include <gtest/gtest.h>

#include <random>

#include "fathom/lens/preimages.h"
#include "fathom/render.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using testing::Case;
using testing::CaseMaker;
using testing::Kind;

struct LensCase {
  Case view;
  oracle::LensNumbers numbers;
};

/// Random lenses of few bits in front of the cameras of CaseMaker; some of the scenes are moved so
/// that corners and edges lie on the ray of a sample, exactly.
class LensCaseMaker {
 public:
  LensCaseMaker(std::uint64_t seed, Kind kind) : random_(seed), cases_(seed + 1, kind) {}

  LensCase make(LensModel model) {
    LensCase c;
    do c.view = cases_.make();
    while (is_orthographic(c.view.camera.projection));
    set_lens(model, c);
    if (below(2) == 0) put_corners_on_a_ray(c);
    return c;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double term() { return std::ldexp(below(9) - 5, -4 - below(3)); }
  double small_term() { return below(2) == 0 ? 0 : std::ldexp(below(5) - 2, -7); }

  void set_lens(LensModel model, LensCase& c) {
    Lens lens{model};
    oracle::LensNumbers& n = c.numbers;
    switch (model) {
      case LensModel::simple_radial:
        lens.distortion[0] = n.above[0] = term();
        break;
      case LensModel::radial:
        lens.distortion[0] = n.above[0] = term();
        lens.distortion[1] = n.above[1] = term() / 4;
        break;
      case LensModel::opencv:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.p1 = small_term(),
                           n.p2 = small_term()};
        break;
      case LensModel::full_opencv:
      case LensModel::opencv_14:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.p1 = small_term(),
                           n.p2 = small_term(), n.above[2] = term() / 8};
        if (below(2) == 0) {
          lens.distortion[5] = n.below[0] = term() / 2;
          lens.distortion[6] = n.below[1] = term() / 8;
          lens.distortion[7] = n.below[2] = term() / 16;
        }
        if (model == LensModel::full_opencv) break;
        lens.distortion[8] = n.s1 = small_term();
        lens.distortion[9] = n.s2 = small_term() / 2;
        lens.distortion[10] = n.s3 = small_term();
        lens.distortion[11] = n.s4 = small_term() / 2;
        break;
      case LensModel::brown:
        lens.distortion = {n.above[0] = term(),     n.above[1] = term() / 4,
                           n.above[2] = term() / 8, n.above[3] = term() / 16,
                           n.p1 = small_term(),     n.p2 = small_term()};
        break;
      case LensModel::simple_division:
      case LensModel::division:
        lens.distortion[0] = term();
        n.division = lens.distortion[0];
        break;
      case LensModel::fisheye_stereographic:
        n.division = -0.25;
        break;
      default:
        break;
    }
    Projection& projection = c.view.camera.projection;
    if (has_one_focal_length(entry_of(model))) {
      projection.fy = projection.fx;
      projection.skew = 0;
    }
    projection.lens = lens;
  }

  /// Moves the image so that a sample sees a point m of few bits, and corners onto its ray.
  void put_corners_on_a_ray(LensCase& c) {
    Camera& camera = c.view.camera;
    Projection& p = camera.projection;
    if (c.numbers.division) return;
    for (const double below : c.numbers.below)
      if (below != 0) return;
    const double x = std::ldexp(this->below(9) - 4, -3), y = std::ldexp(this->below(9) - 4, -3);
    const double q = x * x + y * y;
    double factor = 1, power = 1;
    for (const double k : c.numbers.above) factor += k * (power *= q);
    const oracle::LensNumbers& n = c.numbers;
    const double gx =
        x * factor + 2 * n.p1 * x * y + n.p2 * (q + 2 * x * x) + n.s1 * q + n.s2 * q * q;
    const double gy =
        y * factor + n.p1 * (q + 2 * y * y) + 2 * n.p2 * x * y + n.s3 * q + n.s4 * q * q;
    p.skew = 0;
    p.pixel_centre = 0.5;
    p.cx = this->below(6) + 0.5 - p.fx * gx;
    p.cy = this->below(5) + 0.5 - p.fy * gy;
    camera.world_to_camera = Camera().world_to_camera;
    for (Mesh& mesh : c.view.scene.meshes) {
      std::vector<MeshPoint> corners(mesh.vertices.begin(), mesh.vertices.end());
      for (std::size_t i = 0; i + 1 < corners.size(); i += 2) {
        const double z = 1 + this->below(4);
        const double across = std::ldexp(this->below(9) - 4, -1),
                     up = std::ldexp(this->below(9) - 4, -1);
        // Either the corner is on the ray, or the ray meets the middle between two corners.
        const double aside = this->below(2);
        corners[i] = {x * z + aside * across, y * z + aside * up, z};
        if (aside != 0) corners[i + 1] = {x * z - across, y * z - up, z};
      }
      mesh.vertices = std::move(corners);
    }
  }

  std::mt19937_64 random_;
  CaseMaker cases_;
};

struct Tally {
  int hits = 0, without_ray = 0;
  RenderStatistics statistics;
};

void check(const LensCase& c, Tally& tally) {
  const Camera& camera = c.view.camera;
  RenderOptions options;
  options.engine = Engine::reference;
  options.channels = testing::all_channels();
  options.channels.push_back(Channel::valid);
  options.threads = 1;
  const auto [map, statistics, doubtful] = render(c.view.scene, camera, options);
  add(tally.statistics, statistics);
  const double disc = lens::Preimages(camera.projection, *camera.projection.lens).disc();
  const oracle::RayCaster rays = testing::cast_at(c.view.scene, camera, c.numbers, disc);
  const auto& valid = *map.values<std::uint32_t>("valid");
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool has_ray = valid[static_cast<std::size_t>(6 * y + x)] == 1;
      tally.without_ray += !has_ray;
      ASSERT_EQ(rays.sees(x, y), has_ray) << x << ' ' << y << ' ' << disc;
      const auto hit = has_ray ? rays.cast(x, y) : std::nullopt;
      testing::expect_pixel(map, x, y, hit, c.view.scene);
      tally.hits += hit.has_value();
    }
  }
}

class LensMaps : public ::testing::TestWithParam<std::tuple<LensModel, Kind>> {};

TEST_P(LensMaps, EveryChannelOfEveryPixelAgreesWithRationalRays) {
  const auto [model, kind] = GetParam();
  LensCaseMaker maker(
      static_cast<std::uint64_t>(100 * static_cast<int>(model)) + static_cast<std::uint64_t>(kind),
      kind);
  Tally tally;
  for (int i = 0; i < 60 / testing::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(model), tally);
  }
  EXPECT_GT(tally.hits, 60 / testing::effort);
  if (model == LensModel::simple_radial || model == LensModel::opencv) {
    EXPECT_GT(tally.without_ray, 0);
  }
  if (testing::effort == 1) {
    EXPECT_GT(tally.statistics.edges.exact, 0U);
  }
}

constexpr std::array models{
    LensModel::simple_radial, LensModel::radial,          LensModel::opencv,
    LensModel::full_opencv,   LensModel::opencv_14,       LensModel::brown,
    LensModel::division,      LensModel::simple_division, LensModel::fisheye_stereographic};

std::string name_of_case(const ::testing::TestParamInfo<std::tuple<LensModel, Kind>>& info) {
  const auto [model, kind] = info.param;
  return std::string(name_of(model)) + (kind == Kind::few_bits ? "_few_bits" : "_neighbours");
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, LensMaps,
                         ::testing::Combine(::testing::ValuesIn(models),
                                            ::testing::Values(Kind::few_bits, Kind::neighbours)),
                         name_of_case);

}  // namespace
}  // namespace fathom
