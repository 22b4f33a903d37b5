// The pipeline against rays in long double: what is seen at each sample, how deep, and in what
// colour. The model shares no step with the pipeline: no matrices, no clipping, no window, no edge
// functions.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "fathom/pipeline/render_pipeline.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

using Number = long double;
using LongVector = std::array<Number, 3>;

Number volume(const LongVector& a, const LongVector& b, const LongVector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Where a ray meets the plane of a triangle.
struct Hit {
  std::array<Number, 3> weights;  ///< of the corners on the surface; they add up to 1
  std::array<Number, 3> affine;   ///< in the window
  Number depth;
  [[nodiscard]] Number least() const { return *std::min_element(weights.begin(), weights.end()); }
};

class Model {
 public:
  Model(const Scene& scene, const Camera& camera) : mesh_(scene.meshes[0]), camera_(camera) {
    const auto& m = camera.world_to_camera;
    for (const MeshPoint& p : mesh_.vertices) {
      LongVector q{};
      for (std::size_t i = 0; i < 3; ++i) {
        q[i] = Number(m[i][0]) * p.x + Number(m[i][1]) * p.y + Number(m[i][2]) * p.z + m[i][3];
      }
      points_.push_back(q);
    }
  }

  [[nodiscard]] std::optional<Hit> hit(std::size_t t, Number u, Number v) const {
    const LongVector ray{(u - camera_.projection.cx) / camera_.projection.fx,
                         (v - camera_.projection.cy) / camera_.projection.fy, 1};
    const auto& [a, b, c] = mesh_.triangles[t];
    const LongVector &A = points_[a], &B = points_[b], &C = points_[c];
    const LongVector w{volume(ray, B, C), volume(A, ray, C), volume(A, B, ray)};
    const Number sum = w[0] + w[1] + w[2];
    Hit h{{w[0] / sum, w[1] / sum, w[2] / sum}, {}, volume(A, B, C) / sum};
    const LongVector scaled{h.weights[0] * A[2], h.weights[1] * B[2], h.weights[2] * C[2]};
    const Number all = scaled[0] + scaled[1] + scaled[2];
    for (std::size_t k = 0; k < 3; ++k) h.affine[k] = scaled[k] / all;
    if (h.depth < camera_.near || h.depth > camera_.far) return std::nullopt;
    return h;
  }

  /// Every triangle at a sample, in their order; nullopt if one of them has an edge next to it, or
  /// a boundary of the view, or two of them are next to each other.
  struct Seen {
    std::size_t triangle;
    Hit hit;
  };
  [[nodiscard]] std::optional<std::vector<Seen>> at(Number u, Number v) const {
    std::vector<Seen> seen;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto h = hit(t, u, v);
      if (!h) continue;
      if (std::abs(h->least()) < 2e-4L || h->depth < 1.001L * camera_.near) return std::nullopt;
      if (h->least() < 0) continue;
      for (const Seen& s : seen) {
        if (std::abs(s.hit.depth - h->depth) < 1e-3L * h->depth) return std::nullopt;
      }
      seen.push_back({t, *h});
    }
    return seen;
  }

  [[nodiscard]] Colour colour(std::size_t t, const std::array<Number, 3>& weights) const {
    Colour result{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        result[c] += static_cast<double>(
            weights[k] * static_cast<Number>(mesh_.colours[mesh_.triangles[t][k]][c]));
      }
    }
    return result;
  }

  static const Seen* nearest(const std::vector<Seen>& seen) {
    const auto least = std::min_element(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
      return a.hit.depth < b.hit.depth;
    });
    return least == seen.end() ? nullptr : &*least;
  }

 private:
  const Mesh& mesh_;
  Camera camera_;
  std::vector<LongVector> points_;
};

/// Turned and moved, with unequal focal lengths and its axis beside the middle.
Camera oblique_camera() {
  Camera camera = checks::camera_of(64, 48, 60);
  camera.projection.fy = 52;
  camera.projection.cx = 30.25;
  camera.projection.cy = 26.5;
  camera.near = 0.5;
  camera.far = 100;
  const double c = std::cos(0.3), s = std::sin(0.3), e = std::cos(-0.2), f = std::sin(-0.2);
  camera.world_to_camera = {{{c, 0, s, 0.125}, {f * s, e, -f * c, -0.25}, {-e * s, f, e * c, 0.5}}};
  return camera;
}

Scene coloured(std::uint64_t seed, int count, double least_z) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> side(-4, 4), z(least_z, 12), unit(0, 1);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    for (int k = 0; k < 3; ++k) vertices.push_back({side(random), side(random), z(random)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Scene scene = checks::scene_of(std::move(vertices), std::move(triangles));
  for (std::size_t i = 0; i < scene.meshes[0].vertices.size(); ++i) {
    const auto part = [&] { return static_cast<float>(unit(random)); };
    scene.meshes[0].colours.push_back({part(), part(), part(), 1});
  }
  return scene;
}

PipelineOptions precise() {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::float64;
  options.subpixel_bits = 16;
  options.shading = Shading::none;
  return options;
}

/// Of a colour, where corners move by 2^-17 of a pixel on triangles whose colour changes by less
/// than ten in a pixel, and colours are kept in binary32.
constexpr double fine = 1e-4;

/// Pixels by rays, for options that select the nearest. Colours are affine in the window if asked.
void expect_as_by_rays(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                       double tolerance, const std::string& what) {
  const Model model(scene, camera);
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  int compared = 0, covered = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const auto seen = model.at(x + 0.5L, y + 0.5L);
      if (!seen) continue;
      ++compared;
      const std::size_t i = y * camera.width + x;
      const auto* nearest = Model::nearest(*seen);
      const Colour& colour = frame.picture.pixels[i];
      if (!nearest) {
        ASSERT_EQ(frame.id[i], no_surface) << what << " " << x << " " << y;
        ASSERT_EQ(frame.depth[i], std::numeric_limits<float>::infinity());
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(static_cast<float>(colour[c]), static_cast<float>(options.background[c]));
        }
        continue;
      }
      ++covered;
      ASSERT_EQ(frame.id[i], nearest->triangle) << what << " " << x << " " << y;
      const auto depth = static_cast<double>(nearest->hit.depth);
      ASSERT_NEAR(static_cast<double>(frame.depth[i]), depth, 10 * tolerance * depth)
          << what << " " << x << " " << y;
      const bool affine = options.interpolation == Interpolation::affine;
      const Colour right =
          model.colour(nearest->triangle, affine ? nearest->hit.affine : nearest->hit.weights);
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(colour[c], right[c], tolerance) << what << " " << x << " " << y;
      }
    }
  }
  EXPECT_GT(compared, 64 * 48 * 9 / 10) << what;
  EXPECT_GT(covered, 200) << what;
}

TEST(SlowPipeline, EveryWayOfDrawingShowsWhatRaysSee) {
  const Camera camera = oblique_camera();
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    for (const double least_z : {1.5, -4.0}) {  // the second reaches behind the eye
      const Scene scene = coloured(seed, 8, least_z);
      PipelineOptions options = precise();
      options.background = {0.25, 0.5, 0.75};
      expect_as_by_rays(scene, camera, options, fine, "edge functions");
      options.blocks = options.early_depth = false;
      expect_as_by_rays(scene, camera, options, fine, "without blocks");
      options.scan = ScanConversion::scan_line;
      expect_as_by_rays(scene, camera, options, fine, "scan lines");
      options.early_depth = true;
      expect_as_by_rays(scene, camera, options, fine, "scan lines with early depth");
      options = precise();
      options.precision = Precision::binary32;
      options.depth_format.storage = Storage::float32;
      expect_as_by_rays(scene, camera, options, 5e-3, "binary32");
      for (const Mapping mapping : {Mapping::opengl, Mapping::reversed, Mapping::infinite,
                                    Mapping::reversed_infinite, Mapping::linear, Mapping::log}) {
        options = precise();
        options.depth_format.mapping = mapping;
        expect_as_by_rays(scene, camera, options, fine, std::string(name_of(mapping)));
      }
      for (const Mapping mapping : {Mapping::standard, Mapping::reversed}) {
        options = precise();
        options.depth_format.mapping = mapping;
        options.hidden_surface = HiddenSurface::painter;
        expect_as_by_rays(scene, camera, options, fine, "painter");
      }
    }
  }
}

TEST(SlowPipeline, AffineAttributesAreAffineInTheWindow) {
  const Camera camera = oblique_camera();
  for (const std::uint64_t seed : {5, 6}) {
    const Scene scene = coloured(seed, 8, 4);
    PipelineOptions options = precise();
    options.interpolation = Interpolation::affine;
    // Only what is not clipped: corners that clipping makes have perspective-correct values.
    Camera wide = camera;
    wide.width = wide.height = 512;
    wide.projection.cx = wide.projection.cy = 256;
    ASSERT_EQ(render_frame(scene, wide, options, false).statistics.clipped, 0u);
    for (const auto scan : {ScanConversion::edge_function, ScanConversion::scan_line}) {
      options.scan = scan;
      expect_as_by_rays(scene, wide, options, fine, "affine");
    }
  }
}

TEST(SlowPipeline, FarAndReversedRangesAreKept) {
  const Scene scene = coloured(7, 8, 1.5);
  Camera camera = oblique_camera();
  PipelineOptions options = precise();
  options.depth_range = {0.75, 0.25};  // near is greater: greater is nearer
  expect_as_by_rays(scene, camera, options, fine, "reversed range");
  options.depth_range = {0, 1};
  camera.near = 4;
  camera.far = 7;
  expect_as_by_rays(scene, camera, options, fine, "between 4 and 7");
  options.depth_format.mapping = Mapping::opengl;
  expect_as_by_rays(scene, camera, options, fine, "between 4 and 7, OpenGL");
}

TEST(SlowPipeline, BlendingLaysOneColourOverAnother) {
  const Camera camera = oblique_camera();
  for (const bool painter : {false, true}) {
    for (const auto scan : {ScanConversion::edge_function, ScanConversion::scan_line}) {
      const Scene scene = coloured(8, 6, 1.5);
      PipelineOptions options = precise();
      options.scan = scan;
      options.blend_alpha = 0.375;
      options.background = {1, 0.5, 0};
      if (painter) options.hidden_surface = HiddenSurface::painter;
      const Model model(scene, camera);
      const PipelineFrame frame = render_frame(scene, camera, options, true);
      int deep = 0;
      for (std::uint32_t y = 0; y < camera.height; ++y) {
        for (std::uint32_t x = 0; x < camera.width; ++x) {
          auto seen = model.at(x + 0.5L, y + 0.5L);
          if (!seen) continue;
          if (painter) {
            std::sort(seen->begin(), seen->end(),
                      [](const auto& a, const auto& b) { return a.hit.depth > b.hit.depth; });
          }
          Colour right = options.background;
          for (const auto& s : *seen) {
            const Colour c = model.colour(s.triangle, s.hit.weights);
            for (std::size_t k = 0; k < 3; ++k) right[k] = 0.375 * c[k] + 0.625 * right[k];
          }
          for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_NEAR(frame.picture.at(x, y)[k], right[k], fine) << x << " " << y;
          }
          const auto* nearest = Model::nearest(*seen);
          if (nearest) {
            ASSERT_EQ(frame.id[y * camera.width + x], nearest->triangle);
          }
          deep += seen->size() > 1;
        }
      }
      EXPECT_GT(deep, 100);
    }
  }
}

/// The mean of what rays see at the samples of each pixel.
template <class Samples>
void expect_means(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                  const Samples& samples) {
  const Model model(scene, camera);
  const ColourImage picture = render_frame(scene, camera, options, true).picture;
  int partial = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      Colour sum{};
      bool certain = true;
      std::size_t covered = 0;
      for (const auto& [dx, dy] : samples) {
        const auto seen = model.at(x + Number(dx), y + Number(dy));
        certain = certain && seen;
        if (!seen) continue;
        const auto* nearest = Model::nearest(*seen);
        if (!nearest) continue;
        ++covered;
        const Colour c = model.colour(nearest->triangle, nearest->hit.weights);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
      }
      if (!certain) continue;
      partial += covered > 0 && covered < samples.size();
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(picture.at(x, y)[k], sum[k] / static_cast<double>(samples.size()), fine)
            << x << " " << y;
      }
    }
  }
  EXPECT_GT(partial, 50);
}

TEST(SlowPipeline, SupersamplingIsTheMeanOfItsRays) {
  const Scene scene = coloured(9, 6, 1.5);
  PipelineOptions options = precise();
  for (const int n : {2, 3}) {
    options.antialias = {AntialiasMethod::ssaa, n};
    std::vector<std::array<double, 2>> samples;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) samples.push_back({(i + 0.5) / n, (j + 0.5) / n});
    }
    expect_means(scene, oblique_camera(), options, samples);
  }
  // Frames at Halton's places, base 2 and 3, from the first on.
  options.antialias = {AntialiasMethod::taa, 4};
  expect_means(scene, oblique_camera(), options,
               std::vector<std::array<double, 2>>{
                   {1. / 2, 1. / 3}, {1. / 4, 2. / 3}, {3. / 4, 1. / 9}, {1. / 8, 4. / 9}});
}

TEST(SlowPipeline, MultisamplingShadesATriangleOnceInAPixel) {
  const Camera camera = oblique_camera();
  const Scene scene = coloured(10, 1, 3);
  const std::array<std::array<double, 2>, 4> places{
      {{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}}};
  PipelineOptions options = precise();
  options.antialias = {AntialiasMethod::msaa, 4};
  const ColourImage picture = render_frame(scene, camera, options, true).picture;
  const Model model(scene, camera);
  int beside = 0, partial = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      std::vector<std::array<double, 2>> covered;
      bool certain = true;
      for (const auto& [dx, dy] : places) {
        const auto seen = model.at(x + 0.5L + dx, y + 0.5L + dy);
        certain = certain && seen;
        if (seen && !seen->empty()) covered.push_back({dx, dy});
      }
      const auto centre = model.at(x + 0.5L, y + 0.5L);
      if (!certain || !centre) continue;
      // The centre if it is covered, else the mean of the covered samples.
      Number u = x + 0.5L, v = y + 0.5L;
      if (centre->empty()) {
        for (const auto& [dx, dy] : covered) {
          u += dx / static_cast<Number>(covered.size());
          v += dy / static_cast<Number>(covered.size());
        }
        beside += !covered.empty();
      }
      partial += !covered.empty() && covered.size() < 4;
      const auto there = model.hit(0, u, v);
      for (std::size_t k = 0; k < 3; ++k) {
        const double shaded = covered.empty() ? 0 : model.colour(0, there->weights)[k];
        ASSERT_NEAR(picture.at(x, y)[k], shaded * static_cast<double>(covered.size()) / 4, fine)
            << x << " " << y;
      }
    }
  }
  EXPECT_GT(beside, 5);
  EXPECT_GT(partial, 20);
}

}  // namespace
}  // namespace fathom::pipeline
