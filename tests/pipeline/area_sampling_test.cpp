#include "fathom/pipeline/output/area_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"

namespace fathom::pipeline {
namespace {

/// Everywhere in the pixel.
constexpr PixelForm everywhere{0, 0, 1};

std::map<std::uint32_t, double> areas_of(const std::vector<PixelSurface>& surfaces,
                                         bool painter = false) {
  PixelPartition partition;
  partition.clear();
  for (const PixelSurface& s : surfaces) partition.add(s, painter);
  std::map<std::uint32_t, double> areas;
  for (const SeenPart& part : partition.seen()) areas[part.number] = part.area;
  return areas;
}

constexpr std::uint32_t nothing = PixelPartition::nothing;

TEST(PixelPartition, GivesAHalfPlaneItsArea) {
  // x + 2y ≥ 1.5: a trapezoid with the sides 1 − 0.75 = 0.25 at x = 0 and 1 − 0.25 = 0.75 at x = 1.
  const auto areas = areas_of({{0, {PixelForm{1, 2, -1.5}, everywhere, everywhere}, {}}});
  EXPECT_NEAR(areas.at(0), 0.5, 1e-15);
  EXPECT_NEAR(areas.at(nothing), 0.5, 1e-15);
  PixelPartition partition;
  partition.clear();
  partition.add({7, {PixelForm{1, 0, -0.25}, everywhere, everywhere}, {}});
  ASSERT_EQ(partition.seen().size(), 2U);
  EXPECT_EQ(partition.seen()[0].number, 7U);
  EXPECT_EQ(partition.seen()[0].area, 0.75);
  EXPECT_NEAR(partition.seen()[0].centroid.x, 0.625, 1e-15);
  EXPECT_NEAR(partition.seen()[0].centroid.y, 0.5, 1e-15);
}

/// Two planes cross at x = 0.3: on its left the first is nearer.
TEST(PixelPartition, DividesSurfacesThatPenetrateEachOtherWhereTheyCross) {
  const PixelSurface falling{0, {everywhere, everywhere, everywhere}, {-1, 0, 0.3}};
  const PixelSurface rising{1, {everywhere, everywhere, everywhere}, {1, 0, -0.3}};
  for (const auto& order : {std::vector{falling, rising}, std::vector{rising, falling}}) {
    const auto areas = areas_of(order);
    EXPECT_NEAR(areas.at(0), 0.3, 1e-15);
    EXPECT_NEAR(areas.at(1), 0.7, 1e-15);
    EXPECT_EQ(areas.count(nothing), 0U);
  }
}

TEST(PixelPartition, TheLowerNumberIsSeenWhereTwoAreEquallyNearAndTheLaterWhenPainting) {
  const PixelSurface first{0, {everywhere, everywhere, everywhere}, {0.25, 0.5, 1}};
  PixelSurface second = first;
  second.number = 1;
  for (const auto& order : {std::vector{first, second}, std::vector{second, first}}) {
    EXPECT_EQ(areas_of(order), (std::map<std::uint32_t, double>{{0, 1}}));
    EXPECT_EQ(areas_of(order, true), (std::map<std::uint32_t, double>{{order.back().number, 1}}));
  }
}

/// Triangles whose corners lie on the grid, many of which penetrate each other, in 6 × 6 pixels.
Scene crossing_triangles(std::uint32_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  // Within the image: the corners that clipping makes would be snapped.
  std::uniform_int_distribution<int> place(0, 6 * 64), depth(65, 127);
  Scene scene;
  Mesh mesh;
  for (std::uint32_t i = 0; i < 3 * count; ++i) {
    mesh.vertices.push_back({place(random) / 64.0, place(random) / 64.0, depth(random) / 128.0});
    mesh.colours.push_back({static_cast<float>(i / 3 % 5) / 4, static_cast<float>(i / 3 % 7) / 6,
                            static_cast<float>(i / 3 % 3) / 2, 1});
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  mesh.face_count = count;
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({});
  return scene;
}

Camera six_pixels() {
  Camera camera;
  camera.width = camera.height = 6;
  camera.projection.model = ProjectionModel::orthographic;
  camera.near = 0.25;
  camera.far = 1;
  return camera;
}

Colour colour_of(const Scene& scene, std::uint32_t triangle) {
  const auto& c = scene.meshes[0].colours[3 * std::size_t{triangle}];
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

/// Exact visible areas times colours.
std::vector<Colour> exact_picture(const Scene& scene, const Camera& camera) {
  const DeepMap deep = render_deep(scene, camera);
  std::vector<Colour> picture;
  std::size_t next = 0;
  for (const std::uint32_t count : deep.counts) {
    Colour colour{};
    for (const std::size_t end = next + count; next < end; ++next) {
      const DeepSample& sample = deep.samples[next];
      for (std::size_t k = 0; k < 3; ++k)
        colour[k] += static_cast<double>(sample.area) * colour_of(scene, sample.id)[k];
    }
    picture.push_back(colour);
  }
  return picture;
}

/// Nothing is snapped here, so what is left is the rounding of the exact areas to binary32 (2⁻²⁵
/// each, and they add up to at most 1) and of everything to binary64, which is far less.
TEST(AreaSampling, IsTheExactPictureWhereNothingIsSnapped) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.antialias.method = AntialiasMethod::area;
  std::size_t several = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = crossing_triangles(4 + static_cast<std::uint32_t>(seed), seed);
    const auto exact = exact_picture(scene, six_pixels());
    const auto picture = render_frame(scene, six_pixels(), options, true).picture;
    for (std::size_t i = 0; i < exact.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(picture.pixels[i][k], exact[i][k], 0x1p-24) << "seed " << seed << ' ' << i;
    const DeepMap deep = render_deep(scene, six_pixels());
    several += static_cast<std::size_t>(
        std::count_if(deep.counts.begin(), deep.counts.end(), [](auto n) { return n > 3; }));
  }
  EXPECT_GT(several, 100U);  // the scenes are as crowded as they are meant to be
}

/// A part of a triangle is shaded at its centroid, where an affine colour is its mean over the
/// part.
TEST(AreaSampling, ShadesAPartAtItsCentroid) {
  Scene scene;
  Mesh mesh;
  // Red is x/8 and green y/8 in pixels; right of x + y/2 = 3.25 it covers everything.
  for (const auto& [x, y] : {std::pair{3.25, 0.0}, {8.0, 0.0}, {8.0, 6.0}, {0.25, 6.0}}) {
    mesh.vertices.push_back({x, y, 0.5});
    mesh.colours.push_back({static_cast<float>(x / 8), static_cast<float>(y / 8), 0, 1});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 1;
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({});
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.subpixel_bits = 16;  // for the corners that clipping makes
  options.antialias.method = AntialiasMethod::area;
  const ColourImage picture = render_frame(scene, six_pixels(), options, true).picture;
  // Pixel (5, 1): covered whole by the first triangle.
  EXPECT_NEAR(picture.at(5, 1)[0], 5.5 / 8, 0x1p-17);
  EXPECT_NEAR(picture.at(5, 1)[1], 1.5 / 8, 0x1p-17);
  // Pixel (3, 0): the edge goes from (3.25, 0) to (2.75, 1), through (3, ½). ∫ x and ∫ y over the
  // part, the pixel less a triangle of area 1/16 with the centroid (3 + 1/12, 1/6).
  EXPECT_NEAR(picture.at(3, 0)[0], (3.5 - (3 + 1.0 / 12) / 16) / 8, 0x1p-17);
  EXPECT_NEAR(picture.at(3, 0)[1], (0.5 - 1.0 / 6 / 16) / 8, 0x1p-17);
}

/// A scissor box cuts the picture and changes nothing else; the rest is background.
TEST(AreaSampling, ObeysTheScissorBox) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.antialias.method = AntialiasMethod::area;
  options.background = {0.25, 0.5, 0.75};
  const Scene scene = crossing_triangles(12, 7);
  const ColourImage whole = render_frame(scene, six_pixels(), options, true).picture;
  for (const auto& box : {WindowRectangle{2, 1, 3, 2}, WindowRectangle{-4, 3, 7, 90},
                          WindowRectangle{5, 5, 1, 1}, WindowRectangle{7, 0, 3, 3}}) {
    options.scissor = box;
    const ColourImage cut = render_frame(scene, six_pixels(), options, true).picture;
    for (std::uint32_t y = 0; y < 6; ++y) {
      for (std::uint32_t x = 0; x < 6; ++x) {
        // The window's origin is its lower left corner.
        const std::int64_t row = 5 - std::int64_t{y};
        const bool inside =
            x >= box.x && x < box.x + box.width && row >= box.y && row < box.y + box.height;
        EXPECT_EQ(cut.at(x, y), inside ? whole.at(x, y) : options.background) << x << ' ' << y;
      }
    }
  }
}

/// The mappings that are computed for each fragment decide alike, under perspective too.
TEST(AreaSampling, EveryMappingSeesTheSameSurfaces) {
  Camera camera = six_pixels();
  camera.projection.model = ProjectionModel::perspective;
  camera.projection.fx = camera.projection.fy = 0.75;
  const Scene scene = crossing_triangles(12, 99);
  const auto picture = [&](Mapping mapping) {
    PipelineOptions options;
    options.precision = Precision::binary64;
    options.shading = Shading::none;
    options.subpixel_bits = 16;
    options.antialias.method = AntialiasMethod::area;
    options.depth_format = {mapping, Storage::float64, 0, 0, 1};
    return render_frame(scene, camera, options, true).picture;
  };
  const ColourImage standard = picture(Mapping::standard);
  const auto lit = [](const Colour& c) { return c[0] + c[1] + c[2] > 0; };
  EXPECT_GT(std::count_if(standard.pixels.begin(), standard.pixels.end(), lit), 20);
  for (const Mapping mapping : {Mapping::reversed, Mapping::linear, Mapping::w, Mapping::log}) {
    const ColourImage other = picture(mapping);
    for (std::size_t i = 0; i < standard.pixels.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(other.pixels[i][k], standard.pixels[i][k], 1e-9)
            << name_of(mapping) << ' ' << i;
  }
}

TEST(AreaSampling, DoesNotBlend) {
  PipelineOptions options;
  options.antialias.method = AntialiasMethod::area;
  options.blend_alpha = 0.5;
  EXPECT_THROW(require_meaningful(options), UsageError);
}

}  // namespace
}  // namespace fathom::pipeline
