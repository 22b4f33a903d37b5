// Rows of values from double-words, and of shading normals: what their lanes settle is what the
// functions for one sample settle, which double_word_surface_test.cpp holds to exact numbers.
#include "fathom/fast/channels/wide_rows.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>

#include "fathom/fast/pixels/shading_normals.h"
#include "fathom/fast/pixels/surface_values.h"
#include "fathom/numeric/certified_rounding.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

/// Calls test() with the vector code of every target that this processor has.
template <class Test>
void with_each_target(const Test& test) {
  const auto use = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  };
  const std::int64_t supported = hwy::SupportedTargets();
  for (std::int64_t left = supported & HWY_TARGETS; left != 0; left &= left - 1) {
    SCOPED_TRACE(hwy::TargetName(left & -left));
    use(left & -left);
    test();
  }
  use(0);
}

enum class Kind { perspective, skewed, orthographic };

/// Eight random triangles, the last of which is at the same depth everywhere.
class WideRows : public ::testing::TestWithParam<Kind> {
 protected:
  static constexpr std::uint32_t count = 8;

  Scene make_scene() {
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
      const double depth = 5 + unit();
      for (int k = 0; k < 3; ++k) {
        vertices.push_back({4 * unit(), 4 * unit(), t + 1 < count ? 5 + 2 * unit() : depth});
      }
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return checks::scene_of(vertices, triangles);
  }
  Camera make_camera() {
    Camera c = checks::camera_of(64, 64, 70);
    c.projection.cx += unit();
    if (GetParam() == Kind::skewed) {
      c.projection.skew = 11.3;
      c.world_to_camera[0][1] = 0.3;
      c.world_to_camera[1][2] = -0.2;
    }
    if (GetParam() == Kind::orthographic) {
      c.projection.model = ProjectionModel::orthographic;
      c.projection.fx = c.projection.fy = 9.7;
    }
    return c;
  }
  double unit() { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }
  /// Index 0 is that of no surface; runs, and neighbours that differ.
  SurfaceIndices make_indices() {
    SurfaceIndices indices;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const bool run = k % 32 >= 16 && k % 16 != 0;
      indices[k] = run ? indices[k - 1] : static_cast<std::uint32_t>(random() % (count + 1));
    }
    return indices;
  }
  [[nodiscard]] static ImagePoint sample(const SurfaceRow& row, std::size_t k) {
    return {row.first_u + static_cast<double>(k), row.v};
  }

  std::mt19937_64 random{61};
  Scene scene = make_scene();
  Camera camera = make_camera();
  SceneRays rays{scene, camera};
  ValueFrame frame{rays};
  SurfaceRow row{nullptr, nullptr, nullptr, 0.5, 0.5};
};

template <class T>
void expect_settled(const RoundedValues<T>& ours, std::size_t k, const std::optional<T>& value) {
  ASSERT_EQ((ours.settled >> k & 1) != 0, value.has_value()) << k;
  if (value) {
    EXPECT_EQ(ours.values[k], *value) << k;
  }
}

TEST_P(WideRows, AreThoseOfOneSample) {
  std::vector<SurfaceFacts> facts;
  std::vector<WideDepth> depths{unknown_wide_depth()};
  for (std::uint32_t t = 0; t < count; ++t) {
    facts.push_back(surface_facts(t, frame));
    depths.push_back(wide_depth(facts.back(), frame));
  }
  EXPECT_EQ(depths.back().error, 0);
  EXPECT_EQ(depths.back().constant_error, 0);
  with_each_target([&] {
    for (row.v = 0.5; row.v < 64; ++row.v) {
      const SurfaceIndices indices = make_indices();
      RoundedValues<double> depth, distance;
      RoundedValues<float> low;
      round_wide(row, indices, depths.data(), rays, {&depth, &distance, &low});
      for (std::size_t k = 0; k < indices.size() && !HasFatalFailure(); ++k) {
        if (indices[k] == 0) {
          EXPECT_EQ((depth.settled | distance.settled | low.settled) >> k & 1, 0U);
          continue;
        }
        SurfaceValues one(facts[indices[k] - 1], frame, sample(row, k));
        Certified<WordPair> D = one.depth();
        if (indices[k] == count) D = {*one.exact_depth(), 0};
        expect_settled(depth, k, to_binary64(D.value, D.error));
        const bool flat = GetParam() == Kind::orthographic;
        const Certified<WordPair> d = flat ? D : frame.wide.distance(D, frame.rays, sample(row, k));
        expect_settled(distance, k, to_binary64(d.value, d.error));
        const auto Z = to_binary32(D.value, D.error);
        const WordPair rest = two_sum(D.value.hi - static_cast<double>(Z.value_or(0)), D.value.lo);
        expect_settled(low, k, Z ? to_binary32(rest, D.error) : std::nullopt);
      }
    }
  });
}

/// Errors so great that many values are not settled.
TEST_P(WideRows, SettleNoMoreWhereErrorsAreGreat) {
  std::vector<WideDepth> depths{unknown_wide_depth()};
  std::vector<DepthForms<WordPair>> forms;
  for (std::uint32_t t = 0; t < count; ++t) {
    SurfaceFacts facts = surface_facts(t, frame);
    DepthForms<WordPair> f = depth_of(facts, frame);
    // The parts of the bound one at a time, around half a unit in the last place.
    const double share = std::ldexp(1, -54 - static_cast<int>(t / 2) % 3);
    if (t % 2 == 0) {
      f.varying.error = share * std::abs(f.varying.c.hi + 32 * (f.varying.a.hi + f.varying.b.hi));
    } else {
      f.constant.error = share * std::abs(f.constant.value.hi);
    }
    forms.push_back(f);
    depths.push_back({f.varying.c, f.varying.b, f.varying.a, f.constant.value, f.varying.error,
                      f.constant.error});
  }
  std::size_t settled = 0, open = 0;
  with_each_target([&] {
    for (row.v = 0.5; row.v < 64; ++row.v) {
      const SurfaceIndices indices = make_indices();
      RoundedValues<double> depth, distance;
      round_wide(row, indices, depths.data(), rays, {&depth, &distance, nullptr});
      for (std::size_t k = 0; k < indices.size() && !HasFatalFailure(); ++k) {
        if (indices[k] == 0) continue;
        const auto D =
            frame.wide.depth(forms[indices[k] - 1], sample(row, k), frame.image.perspective);
        const auto value = to_binary64(D.value, D.error);
        expect_settled(depth, k, value);
        ++(value ? settled : open);
        const bool flat = GetParam() == Kind::orthographic;
        const Certified<WordPair> d = flat ? D : frame.wide.distance(D, frame.rays, sample(row, k));
        expect_settled(distance, k, to_binary64(d.value, d.error));
      }
    }
  });
  EXPECT_GT(settled, 1000U);
  EXPECT_GT(open, 1000U);
}

/// Settled only where the exact number is; and hardly ever left open without need: weights by rows
/// have slightly wider bounds.
TEST_P(WideRows, ShadingNormalsAreThoseOfOneSample) {
  std::vector<SurfaceFacts> facts;
  std::vector<SurfaceNormals> normals;
  std::vector<LaneShadingNormal> lanes{lane_shading_normal(nullptr)};
  TriangleLanes triangles;
  for (std::uint32_t t = 0; t < count; ++t) {
    facts.push_back(surface_facts(t, frame));
    SurfaceNormals n;
    for (std::size_t i = 0; i < 3; ++i) {
      // The bounds of one of the three, in turn, from far below those of weights to 2⁻³⁰; and a
      // component that is exactly 0.
      const auto some = [&](std::size_t which) -> Certified<double> {
        if (t == 3 && i == 1) return {0, 0};
        const int bits = t % 3 == which ? 30 + static_cast<int>(t) : 60;
        return {unit(), std::ldexp(1, -bits)};
      };
      n.at_A[i] = some(0);
      n.to_B[i] = some(1);
      n.to_C[i] = some(2);
      for (std::size_t c = 0; c < 3; ++c) {
        const MeshPoint& X = facts.back().corners[c];
        triangles.corners[c][i][t] = i == 0 ? X.x : i == 1 ? X.y : X.z;
      }
    }
    normals.push_back(n);
    lanes.push_back(lane_shading_normal(&n));
  }
  std::array<std::vector<LaneForm>, 3> forms;
  for (auto& f : forms) f.assign(1 + TriangleLanes::most, LaneForm{0, 0, 0, INFINITY});
  const LaneForms begin{forms[0].data() + 1, forms[1].data() + 1, forms[2].data() + 1};
  std::size_t settled = 0, open = 0, open_without_need = 0, settled_without_right = 0;
  with_each_target([&] {
    make_weight_forms(triangles, *facts[0].object, frame.image, begin);
    for (row.v = 0.5; row.v < 64; ++row.v) {
      const SurfaceIndices indices = make_indices();
      std::array<RoundedValues<float>, 3> rounded;
      round_shading_normals(row, indices, {forms[0].data(), forms[1].data(), forms[2].data()},
                            lanes.data(), rounded);
      for (std::size_t k = 0; k < indices.size(); ++k) {
        const bool ours = (rounded[0].settled >> k & 1) != 0;
        if (indices[k] == 0) {
          EXPECT_FALSE(ours);
          continue;
        }
        const auto& w = weights_of(facts[indices[k] - 1], frame);
        const ImagePoint s = sample(row, k);
        const auto n = fast::unit(interpolated(normals[indices[k] - 1], {w.at(0, s), w.at(1, s)}));
        bool known = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto value = to_binary32(n[i].value, n[i].error);
          known = known && value;
          if (ours && value) {
            EXPECT_EQ(rounded[i].values[k], *value) << k;
          }
        }
        ++(ours ? settled : open);
        open_without_need += !ours && known;
        settled_without_right += ours && !known;
      }
    }
  });
  EXPECT_GT(settled, 5000U);
  EXPECT_GT(open, 50U);
  EXPECT_LE(open_without_need, open / 20);
  // Roundings of the two differ.
  EXPECT_LE(settled_without_right, open / 100);
}

INSTANTIATE_TEST_SUITE_P(Fast, WideRows,
                         ::testing::Values(Kind::perspective, Kind::skewed, Kind::orthographic));

}  // namespace
}  // namespace fathom
