// Options that mean nothing, or do not go together, are refused; these and no others.
#include "fathom/pipeline/options.h"

#include <gtest/gtest.h>

#include <functional>

#include "fathom/numeric/errors.h"

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
  const auto count_refused = [](AntialiasMethod method, int most) {
    int refused = 0;
    for (int n = 0; n <= most; ++n) {
      refused += is_refused([&](PipelineOptions& o) { o.antialias = {method, n}; });
    }
    return refused;
  };
  EXPECT_EQ(count_refused(AntialiasMethod::msaa, 300), 301 - 5);
  EXPECT_EQ(count_refused(AntialiasMethod::ssaa, 300), 301 - 16);
  EXPECT_EQ(count_refused(AntialiasMethod::jitter, 300), 301 - 5);
  EXPECT_EQ(count_refused(AntialiasMethod::taa, 300), 301 - 256);
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

}  // namespace
}  // namespace fathom::pipeline
