// What the depth buffer holds: against the exact codes of depth_format, and by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/render_by_pipeline.h"
#include "tests/pipeline/layers.h"

namespace fathom::pipeline {
namespace {

using testing::Each;
using testing::HasSubstr;

PipelineOptions precise(Mapping mapping, Storage storage) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format = {mapping, storage, 0, 0, 1};
  return options;
}

PipelineRendering rendered(const Scene& scene, const PipelineOptions& options,
                           const Camera& camera = camera_of_layers()) {
  return render_by_pipeline(scene, camera, options, {Channel::Z, Channel::id}, true);
}

std::uint64_t code_of(const Scene& scene, const PipelineOptions& options) {
  const std::vector<StoredDepth> stored = rendered(scene, options).depth_buffer.stored;
  EXPECT_THAT(stored, Each(stored[0]));
  return stored[0].bits;
}

std::string failure(const Scene& scene, const PipelineOptions& options) {
  try {
    rendered(scene, options);
  } catch (const InputError& error) {
    return error.what();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

DrawState with_offset(double factor, double units) {
  DrawState state;
  state.polygon_offset = PolygonOffset{factor, units};
  return state;
}

/// A plane at a constant depth is stored as the exact code of that depth. Of a float64, which holds
/// every rounding of a transform of about ten operations, the last bits differ.
TEST(StoredDepth, IsTheExactCodeInEveryFormat) {
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      const PipelineOptions options = precise(mapping, storage);
      for (const double depth : {0.75, 3.1, 41.7}) {
        const double far = takes_infinite_far(mapping) ? INFINITY : 100;
        const PipelineRendering r =
            rendered(layers({{depth, {}}}), options, camera_of_layers(0.5, far));
        const DepthFormat format{mapping, storage, 0.5, far, 1};
        const auto exact = static_cast<std::int64_t>(encode(format, Dyadic(depth)).bits);
        for (const StoredDepth stored : r.depth_buffer.stored) {
          const auto off = static_cast<std::int64_t>(stored.bits) - exact;
          EXPECT_LE(std::abs(off), storage == Storage::float64 ? 512 : 0)
              << name_of(mapping) << ' ' << name_of(storage) << ' ' << depth;
        }
      }
    }
  }
}

/// An orthographic matrix makes z = (D − near)/(far − near), or 1 minus that, by hand: 5/8 of the
/// way from 2 to 10 lies 7. Codes mean the depth that they are nearest to.
TEST(StoredDepth, OfAnOrthographicCameraIsAffineInTheDepth) {
  Camera camera = camera_of_layers(2, 10);
  camera.projection.model = ProjectionModel::orthographic;
  for (const Mapping mapping : {Mapping::standard, Mapping::opengl, Mapping::reversed}) {
    for (const std::array<double, 2>& range : {std::array{0.0, 1.0}, {0.75, 0.25}}) {
      PipelineOptions options = precise(mapping, Storage::unorm16);
      options.depth_range = range;
      PipelineRendering r = rendered(layers({{7, {}}}), options, camera);
      const double z = mapping == Mapping::reversed ? 3.0 / 8 : 5.0 / 8;
      const double window = range[0] + z * (range[1] - range[0]);
      for (const StoredDepth stored : r.depth_buffer.stored)
        EXPECT_EQ(stored.bits, static_cast<std::uint64_t>(std::lround(65535 * window)));
      add_depth_buffer(r.map, r.depth_buffer);
      // Half a step of the buffer.
      const double half = 8.0 / 65535 / 2 / std::abs(range[1] - range[0]);
      for (const float decoded : *r.map.values<float>("Zdecoded"))
        EXPECT_NEAR(static_cast<double>(decoded), 7, half + 0x1p-22) << name_of(mapping);
    }
  }
  // What fragments compute is what it is in perspective.
  PipelineRendering r = rendered(layers({{7, {}}}), precise(Mapping::w, Storage::unorm16), camera);
  add_depth_buffer(r.map, r.depth_buffer);
  for (const float decoded : *r.map.values<float>("Zdecoded"))
    EXPECT_NEAR(static_cast<double>(decoded), 7, 10.0 / 65535 / 2 + 0x1p-22);
}

TEST(StoredDepth, BackgroundIsTheFarthestThatCanBeStored) {
  Scene nothing = layers({{1, {}}});
  nothing.meshes[0].triangles.clear();
  nothing.meshes[0].face_of_triangle.clear();
  for (const Mapping mapping : all_mappings) {
    PipelineOptions options = precise(mapping, Storage::unorm16);
    Camera camera = camera_of_layers(0.5, takes_infinite_far(mapping) ? INFINITY : 100);
    const auto background = [&] {
      const PipelineRendering r = rendered(nothing, options, camera);
      EXPECT_THAT(r.depth_buffer.written, Each(false));
      return r.depth_buffer.stored[0].bits;
    };
    EXPECT_EQ(background(), is_reversed(mapping) ? 0U : 65535U) << name_of(mapping);
    if (is_per_fragment(mapping)) continue;
    options.depth_range = {1, 0};
    EXPECT_EQ(background(), is_reversed(mapping) ? 65535U : 0U) << name_of(mapping);
  }
}

/// Units are steps of a unorm format, of the object that has them and of no other.
TEST(PolygonOffset, MovesOneObjectByWholeCodes) {
  const PipelineOptions options = precise(Mapping::standard, Storage::unorm24);
  const std::uint64_t code = code_of(layers({{3, {}}}), options);
  EXPECT_EQ(code_of(layers({{3, with_offset(0, -2)}}), options), code - 2);
  EXPECT_EQ(code_of(layers({{3, with_offset(0, 5)}}), options), code + 5);
  // The second of two coplanar ones loses, but not if it comes two steps nearer.
  EXPECT_THAT(rendered(layers({{3, {}}, {3, {}}}), options).map.values<std::uint32_t>("id")->at(0),
              testing::Lt(2U));
  const Scene decal = layers({{3, {}}, {3, with_offset(0, -2)}});
  EXPECT_THAT(*rendered(decal, options).map.values<std::uint32_t>("id"), Each(testing::Ge(2U)));
  EXPECT_EQ(code_of(decal, options), code - 2);
  // What holds for all does not move one against the other; an object's own replaces it.
  PipelineOptions all = options;
  all.polygon_offset = {0, -2, 0};
  EXPECT_EQ(code_of(layers({{3, {}}, {3, {}}}), all), code - 2);
  EXPECT_EQ(code_of(layers({{3, with_offset(0, 7)}}), all), code + 7);
}

/// The factor times the greatest slope of the window depth per pixel, read off the buffer itself.
TEST(PolygonOffset, FactorIsTimesTheGreatestSlope) {
  Scene plain = layers({{3, {}}});
  for (MeshPoint& p : plain.meshes[0].vertices) p.z += p.x / 32 + p.y / 64;
  Scene moved = plain;
  moved.draw_states[0] = with_offset(3, 0);
  PipelineOptions options = precise(Mapping::standard, Storage::float64);
  options.subpixel_bits = 16;
  const auto depths = [&](const Scene& scene) {
    std::vector<double> z;
    for (const StoredDepth s : rendered(scene, options).depth_buffer.stored)
      z.push_back(std::bit_cast<double>(s.bits));
    return z;
  };
  const std::vector<double> without = depths(plain), with = depths(moved);
  const double slope =
      std::max(std::abs(without[1] - without[0]), std::abs(without[6] - without[0]));
  EXPECT_GT(slope, 1e-3);
  for (std::size_t i = 0; i < with.size(); ++i)
    EXPECT_NEAR(with[i] - without[i], 3 * slope, 1e-9) << i;
}

TEST(PolygonOffset, IsRefusedWhereFragmentsComputeTheirDepth) {
  for (const Mapping mapping : {Mapping::linear, Mapping::w, Mapping::log, Mapping::log_ulrich}) {
    PipelineOptions options = precise(mapping, Storage::unorm24);
    EXPECT_THAT(failure(layers({{3, {}}, {4, with_offset(1, 0)}}), options),
                HasSubstr("object layer 1: a polygon offset does not reach"));
    options.polygon_offset = {0, 1, 0};
    EXPECT_THAT(failure(layers({{3, {}}}), options), HasSubstr("polygon_offset"));
    options.polygon_offset = {};
    options.depth_range = {0, 0.5};
    EXPECT_THAT(failure(layers({{3, {}}}), options), HasSubstr("depth_range"));
  }
}

/// Worked out anew, from the codes: D = near·far / (far − u·(far − near)).
TEST(DepthRange, IsInvertedByWhatIsDecoded) {
  for (const auto& [a, b] : {std::pair(0.0, 1.0), {0.25, 0.75}, {1.0, 0.0}, {0.9, 0.2}}) {
    PipelineOptions options = precise(Mapping::standard, Storage::unorm24);
    options.depth_range = {a, b};
    PipelineRendering r = rendered(layers({{3, {}}}), options);
    add_depth_buffer(r.map, r.depth_buffer);
    const std::uint32_t code = r.map.values<std::uint32_t>("Zwindow")->at(7);
    // f(3) = 100·2.5 / (3·99.5)
    EXPECT_NEAR(code / 16777215.0, a + (b - a) * 250 / 298.5, 0.5 / 16777215 + 1e-12);
    const long double u = (code / 16777215.0L - a) / (b - a);
    EXPECT_FLOAT_EQ(r.map.values<float>("Zdecoded")->at(7),
                    static_cast<float>(50.0L / (100.0L - u * 99.5L)));
    EXPECT_NEAR(r.map.values<float>("Zdecoded")->at(7), 3, 1e-5);
  }
}

TEST(DepthRange, OfOneDepthDecodesNothing) {
  PipelineOptions options = precise(Mapping::standard, Storage::unorm24);
  options.depth_range = {0.5, 0.5};
  PipelineRendering r = rendered(layers({{3, {}}}), options);
  EXPECT_THROW(add_depth_buffer(r.map, r.depth_buffer), UsageError);
}

/// What an offset has moved beyond the far end is decoded as far; where nothing was written, +∞.
TEST(DepthRange, DepthsBeyondItAreDecodedAsItsEnds) {
  PipelineOptions options = precise(Mapping::standard, Storage::unorm16);
  options.depth_range = {0, 0.5};
  PipelineRendering r = rendered(layers({{99, with_offset(0, 1000)}}), options);
  add_depth_buffer(r.map, r.depth_buffer);
  EXPECT_THAT(*r.map.values<float>("Zdecoded"), Each(100.0F));
  DrawState invisible;
  invisible.depth_write = false;
  PipelineRendering none = rendered(layers({{3, invisible}}), options);
  add_depth_buffer(none.map, none.depth_buffer);
  EXPECT_THAT(*none.map.values<float>("Zdecoded"), Each(INFINITY));
  EXPECT_THAT(*none.map.values<std::uint32_t>("Zwindow"), Each(65535U));
}

}  // namespace
}  // namespace fathom::pipeline
