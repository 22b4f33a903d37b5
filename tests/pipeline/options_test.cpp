// Options that mean nothing, or do not go together, are refused; these and no others.
#include "fathom/pipeline/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>

#include "fathom/failures/errors.h"
#include "tests/places.h"

namespace fathom::pipeline {
namespace {

bool is_refused(const std::function<void(PipelineOptions&)>& change) {
  PipelineOptions options;
  change(options);
  try {
    require_meaningful(options);
    return false;
  } catch (const UsageError&) {
    return true;
  }
}

TEST(PipelineOptions, LimitsAreInclusive) {
  EXPECT_FALSE(is_refused([](PipelineOptions&) {}));
  for (const int bits : {0, 16}) {
    EXPECT_FALSE(is_refused([&](PipelineOptions& o) { o.subpixel_bits = bits; }));
  }
  for (const int bits : {-1, 17}) {
    EXPECT_TRUE(is_refused([&](PipelineOptions& o) { o.subpixel_bits = bits; }));
  }
  EXPECT_FALSE(is_refused([](PipelineOptions& o) { o.depth_range = {1, 0}; }));
  EXPECT_TRUE(is_refused([](PipelineOptions& o) { o.depth_range = {0, 1.5}; }));
  EXPECT_FALSE(is_refused([](PipelineOptions& o) { o.viewport = {{-5, -5, 1, 1}}; }));
  EXPECT_TRUE(is_refused([](PipelineOptions& o) { o.viewport = {{0, 0, 0, 1}}; }));
  EXPECT_TRUE(is_refused([](PipelineOptions& o) { o.scissor = {{0, 0, 1, (1 << 20) + 1}}; }));
  for (const double alpha : {-0.1, 1.1}) {
    EXPECT_TRUE(is_refused([&](PipelineOptions& o) { o.blend_alpha = alpha; }));
  }
  EXPECT_FALSE(is_refused([](PipelineOptions& o) { o.blend_alpha = 0; }));
}

TEST(PipelineOptions, SamplesThatThereAre) {
  const auto accepted = [](AntialiasMethod method) {
    std::vector<int> counts;
    for (int n = -1; n <= 300; ++n) {
      if (!is_refused([&](PipelineOptions& o) { o.antialias = {method, n}; })) counts.push_back(n);
    }
    return counts;
  };
  const auto to = [](int last) {
    std::vector<int> counts(static_cast<std::size_t>(last));
    std::iota(counts.begin(), counts.end(), 1);
    return counts;
  };
  EXPECT_EQ(accepted(AntialiasMethod::msaa), (std::vector<int>{1, 2, 4, 8, 16}));
  EXPECT_EQ(accepted(AntialiasMethod::ssaa), to(16));
  EXPECT_EQ(accepted(AntialiasMethod::jitter), (std::vector<int>{1, 4, 16, 64, 256}));
  EXPECT_EQ(accepted(AntialiasMethod::taa), to(256));
  EXPECT_EQ(accepted(AntialiasMethod::temporal), to(256));
}

TEST(PipelineOptions, WhatDoesNotGoTogether) {
  const auto with = [](AntialiasMethod method) { return Antialias{method, 4}; };
  EXPECT_TRUE(is_refused([&](PipelineOptions& o) {
    o.scan = ScanConversion::scan_line;
    o.antialias = with(AntialiasMethod::msaa);
  }));
  EXPECT_FALSE(is_refused([&](PipelineOptions& o) {
    o.scan = ScanConversion::scan_line;
    o.antialias = with(AntialiasMethod::fxaa);
  }));
  for (const Shading shading : {Shading::points, Shading::wireframe}) {
    EXPECT_TRUE(is_refused([&](PipelineOptions& o) {
      o.shading = shading;
      o.antialias = with(AntialiasMethod::area);
    }));
    EXPECT_TRUE(is_refused([&](PipelineOptions& o) {
      o.shading = shading;
      o.hidden_surface = HiddenSurface::painter;
    }));
    EXPECT_FALSE(is_refused([&](PipelineOptions& o) { o.shading = shading; }));
  }
}

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(PipelineOptions, DepthsThatFragmentsComputeTakeNoOffsetAndNoRange) {
  for (const Mapping mapping : all_mappings) {
    const auto refused = [&](const DepthBias& offset, const std::array<double, 2>& range) {
      return is_refused([&](PipelineOptions& o) {
        o.depth_format.mapping = mapping;
        o.polygon_offset = offset;
        o.depth_range = range;
      });
    };
    const bool computed = mapping == Mapping::linear || mapping == Mapping::w ||
                          mapping == Mapping::log || mapping == Mapping::log_ulrich;
    EXPECT_FALSE(refused({0, 0, 1}, {0, 1}));
    EXPECT_EQ(refused({1, 0, 0}, {0, 1}), computed);
    EXPECT_EQ(refused({0, 1, 0}, {0, 1}), computed);
    EXPECT_EQ(refused({}, {0.25, 1}), computed);
    EXPECT_EQ(refused({}, {0, 0.75}), computed);
  }
}

TEST(PipelineOptions, EveryNumberIsHeldToItsLimits) {
  const auto all_refused = [](const std::vector<double>& values,
                              const std::function<void(PipelineOptions&, double)>& set) {
    return std::all_of(values.begin(), values.end(), [&](double value) {
      return is_refused([&](PipelineOptions& o) { set(o, value); });
    });
  };
  const auto none_refused = [](const std::vector<double>& values,
                               const std::function<void(PipelineOptions&, double)>& set) {
    return std::none_of(values.begin(), values.end(), [&](double value) {
      return is_refused([&](PipelineOptions& o) { set(o, value); });
    });
  };
  using Set = std::function<void(PipelineOptions&, double)>;
  const std::vector<double> not_finite{infinite, -infinite, std::nan("")};
  // From 0 to 1.
  for (const Set& set : {Set([](auto&o, double v) { o.blend_alpha = v; }),
                         Set([](auto&o, double v) { o.antialias.fxaa.threshold = v; }),
                         Set([](auto&o, double v) { o.antialias.fxaa.least_threshold = v; }),
                         Set([](auto&o, double v) { o.antialias.fxaa.subpixel = v; }),
                         Set([](auto&o, double v) { o.depth_range[0] = v; }),
                         Set([](auto&o, double v) { o.depth_range[1] = v; })}) {
    EXPECT_TRUE(none_refused({0, 0.5, 1}, set));
    EXPECT_TRUE(all_refused({-0x1p-1074, 1 + 0x1p-52, -1, 2}, set));
    EXPECT_TRUE(all_refused(not_finite, set));
  }
  // Finite.
  for (const Set& set : {Set([](auto&o, double v) { o.polygon_offset.slope_factor = v; }),
                         Set([](auto&o, double v) { o.polygon_offset.constant_factor = v; }),
                         Set([](auto&o, double v) { o.light.towards[0] = v; }),
                         Set([](auto&o, double v) { o.light.towards[1] = v; }),
                         Set([](auto&o, double v) { o.light.towards[2] = v; }),
                         Set([](auto&o, double v) { o.background[0] = v; }),
                         Set([](auto&o, double v) { o.background[1] = v; }),
                         Set([](auto&o, double v) { o.background[2] = v; })}) {
    EXPECT_TRUE(none_refused({-1e300, -1, 0, 1, 1e300}, set));
    EXPECT_TRUE(all_refused(not_finite, set));
  }
  // Finite and not below 0.
  for (const Set& set : {Set([](auto&o, double v) { o.material.ambient = v; }),
                         Set([](auto&o, double v) { o.material.diffuse = v; }),
                         Set([](auto&o, double v) { o.material.specular = v; }),
                         Set([](auto&o, double v) { o.material.shininess = v; })}) {
    EXPECT_TRUE(none_refused({0, 1, 1e300}, set));
    EXPECT_TRUE(all_refused({-0x1p-1074, -1}, set));
    EXPECT_TRUE(all_refused(not_finite, set));
  }
  EXPECT_TRUE(is_refused([](PipelineOptions& o) { o.light.towards = {}; }));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_FALSE(
        is_refused([&](PipelineOptions& o) { o.light.towards = {}, o.light.towards[k] = 1; }));
  }
}

TEST(PipelineOptions, AreasDoNotBlendAndThePainterHasAnOrder) {
  for (int method = 0; method <= static_cast<int>(AntialiasMethod::temporal_area); ++method) {
    const bool areas = static_cast<AntialiasMethod>(method) == AntialiasMethod::area ||
                       static_cast<AntialiasMethod>(method) == AntialiasMethod::temporal_area;
    const auto with = [&](std::optional<double> alpha) {
      return is_refused([&](PipelineOptions& o) {
        o.antialias = {static_cast<AntialiasMethod>(method), 4};
        o.blend_alpha = alpha;
      });
    };
    EXPECT_FALSE(with(std::nullopt)) << method;
    EXPECT_EQ(with(0.5), areas) << method;
  }
  const auto ordered = [](DrawOrder order, HiddenSurface hidden) {
    return is_refused([&](PipelineOptions& o) { o.draw_order = order, o.hidden_surface = hidden; });
  };
  EXPECT_FALSE(ordered(DrawOrder::file, HiddenSurface::painter));
  EXPECT_TRUE(ordered(DrawOrder::random, HiddenSurface::painter));
  EXPECT_TRUE(ordered(DrawOrder::front_to_back, HiddenSurface::painter));
  EXPECT_FALSE(ordered(DrawOrder::random, HiddenSurface::z_buffer));
}

/// A number as people write it: 0.15, 40.
std::string written(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// docs/pipeline.md quotes the defaults, which a reader of a picture without options relies on.
TEST(PipelineOptions, DefaultsAreThoseOfTheDocuments) {
  std::ifstream file(test::source_dir() / "docs/pipeline.md");
  const std::string docs{std::istreambuf_iterator<char>(file), {}};
  const PipelineOptions o;
  const auto [ambient, diffuse, specular, shininess, highlight] = o.material;
  EXPECT_NE(docs.find("`--material " + written(ambient) + "," + written(diffuse) + "," +
                      written(specular) + "," + written(shininess) + "`"),
            std::string::npos);
  const auto [x, y, z] = o.light.towards;
  EXPECT_NE(docs.find("(−" + written(-x) + ", −" + written(-y) + ", −" + written(-z) + ")"),
            std::string::npos);
  const FxaaSettings& f = o.antialias.fxaa;
  EXPECT_NE(docs.find(written(f.threshold) + " and " + written(f.least_threshold)),
            std::string::npos);
  EXPECT_NE(docs.find("(" + written(f.subpixel) + ", from 0 to 1)"), std::string::npos);
}

}  // namespace
}  // namespace fathom::pipeline
