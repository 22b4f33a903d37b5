#include "fathom/depth_format/pipeline_model.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

constexpr Mapping projections[] = {Mapping::standard, Mapping::infinite, Mapping::reversed,
                                   Mapping::reversed_infinite, Mapping::opengl};
constexpr PipelineRounding exact{false, false, false, false, true};

DepthFormat format_of(Mapping mapping, Storage storage = Storage::float32) {
  return {mapping, storage, 0.25,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : 1000};
}

/// Vertices in front of the eye of a turned and moved camera.
struct Scene {
  ViewRow view{0.25, -0.5, 0.75, 3};
  std::vector<Vertex> vertices;
};

Scene random_scene() {
  Scene scene;
  std::mt19937_64 random(31);
  const auto number = [&] { return static_cast<float>(random() % 100000) / 128; };
  PipelineModel model;
  model.view = scene.view;
  while (scene.vertices.size() < 500) {
    const Vertex vertex{number(), number(), number()};
    const Ratio depth = exact_depth(model, vertex);
    if (depth < Dyadic(0.25) || Ratio(Dyadic(1000.0)) < depth) continue;
    scene.vertices.push_back(vertex);
  }
  return scene;
}

TEST(PipelineModel, WithoutRoundingIsTheIdealModel) {
  const Scene scene = random_scene();
  for (const Mapping mapping : projections) {
    for (const Storage storage : all_storages) {
      for (const bool premultiplied : {false, true}) {
        const PipelineModel model{format_of(mapping, storage), scene.view, premultiplied, exact};
        for (const Vertex& vertex : scene.vertices) {
          const StoredDepth ideal = encode(model.format, exact_depth(model, vertex));
          ASSERT_EQ(stored_number(model, window_depth(model, vertex)), value_of(storage, ideal));
        }
      }
    }
  }
}

/// The same steps in plain binary32; constants computed in binary64 and rounded, which for near = ¼
/// and far = 1000 is the exact constant rounded once: 999.75 and the products are binary64 numbers,
/// and a quotient that binary64 rounds to a tie of binary32 does not occur among these.
float in_plain_binary32(Mapping mapping, const ViewRow& view, bool premultiplied, const Vertex& p) {
  const double n = 0.25, f = 1000;
  const float A = static_cast<float>(mapping == Mapping::standard   ? f / (f - n)
                                     : mapping == Mapping::reversed ? -n / (f - n)
                                     : mapping == Mapping::infinite ? 1
                                     : mapping == Mapping::opengl   ? (f + n) / (f - n)
                                                                    : 0);
  const float B = static_cast<float>(mapping == Mapping::standard   ? -f * n / (f - n)
                                     : mapping == Mapping::reversed ? f * n / (f - n)
                                     : mapping == Mapping::infinite ? -n
                                     : mapping == Mapping::opengl   ? -2 * f * n / (f - n)
                                                                    : n);
  float v[4], m[4];
  for (int i = 0; i < 4; ++i) {
    v[i] = static_cast<float>(view[i]);
    m[i] = A * v[i];
  }
  m[3] += B;
  const float w = v[0] * p[0] + v[1] * p[1] + v[2] * p[2] + v[3];
  const float z = premultiplied ? m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3] : A * w + B;
  const float ndc = z / w;
  return mapping == Mapping::opengl ? ndc * 0.5F + 0.5F : ndc;
}

TEST(PipelineModel, WithRoundingIsPlainBinary32) {
  const Scene scene = random_scene();
  std::size_t differ = 0;
  for (const Mapping mapping : projections) {
    for (const bool premultiplied : {false, true}) {
      const PipelineModel model{format_of(mapping), scene.view, premultiplied, {}};
      for (const Vertex& vertex : scene.vertices) {
        const float plain = in_plain_binary32(mapping, scene.view, premultiplied, vertex);
        ASSERT_EQ(window_depth(model, vertex), Ratio(Dyadic(static_cast<double>(plain))));
        if (stored_value(model.format, exact_depth(model, vertex)).rational() !=
            Ratio(Dyadic(static_cast<double>(plain)))) {
          ++differ;
        }
      }
    }
  }
  EXPECT_GT(differ, 4000U);  // of 5000: there is rounding to be seen at all
}

TEST(PipelineModel, EachSourceRoundsByItself) {
  const Vertex vertex{0, 0, 3};
  const auto depth_with = [&](PipelineRounding rounding) {
    return window_depth({format_of(Mapping::infinite), identity_view, false, rounding}, vertex);
  };
  const Ratio ideal(Dyadic(2.75), Dyadic(3.0));
  EXPECT_EQ(depth_with(exact), ideal);
  // 1, −¼ and 3 − ¼ are binary32 numbers: only the quotient is not.
  EXPECT_EQ(depth_with({true, false, false, false, true}), ideal);
  EXPECT_EQ(depth_with({false, true, false, false, true}), ideal);
  const Ratio rounded = Dyadic(static_cast<double>(2.75F / 3.0F));
  EXPECT_EQ(depth_with({false, false, true, false, true}), rounded);

  // A matrix that is rounded, and nothing else: A = 1000/999.75 and B = −250/999.75.
  const PipelineModel matrix{
      format_of(Mapping::standard), identity_view, false, {true, false, false, false, true}};
  const Ratio A = Dyadic(static_cast<double>(static_cast<float>(1000 / 999.75)));
  const Ratio B = Dyadic(static_cast<double>(static_cast<float>(-250 / 999.75)));
  EXPECT_EQ(window_depth(matrix, vertex) * Dyadic(3.0), A * Dyadic(3.0) + B);
}

TEST(PipelineModel, InterpolationIsLinearInTheWindow) {
  // 1/D = (1 − t)/D_a + t/D_b with D_a = 1, D_b = 4, t = 2/3: D = 2.
  const Ratio t(Dyadic(2.0), Dyadic(3.0));
  const Vertex a{0, 0, 1}, b{0, 0, 4};
  PipelineModel model{format_of(Mapping::reversed_infinite), identity_view, false, exact};
  EXPECT_EQ(interpolated_window_depth(model, a, b, t), Ratio(Dyadic(0.125)));
  model.rounding.interpolation = true;
  const float z = 0.25F + (2.0F / 3.0F) * (0.0625F - 0.25F);
  EXPECT_EQ(interpolated_window_depth(model, a, b, t), Ratio(Dyadic(static_cast<double>(z))));
}

TEST(PipelineModel, WindowDepthsOutsideOfTheBufferAreLimited) {
  const PipelineModel model{format_of(Mapping::standard), identity_view, false, {}};
  EXPECT_EQ(stored_number(model, Dyadic(-0.5)), Ratio());
  EXPECT_EQ(stored_number(model, Dyadic(1.5)), Ratio(Dyadic(1.0)));
}

TEST(PipelineModel, WhatItCannotDoIsRefused) {
  PipelineModel model;
  for (const Mapping mapping : {Mapping::linear, Mapping::w, Mapping::log, Mapping::log_ulrich}) {
    model.format.mapping = mapping;
    EXPECT_EQ(message_of<UsageError>([&] {
                window_depth(model, {0, 0, 1});
              }),
              "the pipeline model has no projection for mapping " + std::string(name_of(mapping)) +
                  "; there are standard, reversed, infinite, reversed-infinite, opengl");
  }
  model.format = format_of(Mapping::standard);
  EXPECT_THROW(window_depth(model, {0, 0, 0}), UsageError);
  model.view = {0, 0, 1e39, 0};
  EXPECT_THROW(window_depth(model, {0, 0, 1}), UsageError);
}

}  // namespace
}  // namespace fathom
