// What must not change a map with a lens, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/scene_building.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using checks::expect_same_map;
using checks::NamedLens;
using checks::render_tested;
using checks::soup_around_eye;

constexpr std::uint32_t columns = 24, rows = 20;

/// Lenses of few bits, so that samples have edges on their rays; most fold within the image.
std::vector<NamedLens> lenses() {
  return {
      {"barrel", {LensModel::simple_radial, {-0.25}}},
      {"pincushion", {LensModel::radial, {0.125, 0.0625}}},
      {"tangential", {LensModel::opencv, {-0.125, 0.03125, 0.0078125, -0.015625}}},
      {"rational", {LensModel::full_opencv, {-0.125, 0, 0, 0, 0, 0.0625, 0.015625, 0.0078125}}},
      {"tilted", {LensModel::opencv_14, {-0.125, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.05, -0.03}}},
      {"brown", {LensModel::brown, {-0.125, 0.03125, -0.0078125, 0.001953125}}},
      {"field of view", {LensModel::fov, {0.875}}},
      {"division", {LensModel::division, {-0.25}}},
      {"equidistant", {LensModel::simple_fisheye}},
      {"fisheye", {LensModel::opencv_fisheye, {0.03125, -0.0078125}}},
      {"two stages",
       {LensModel::rad_tan_thin_prism_fisheye,
        {0.03125, -0.0078125, 0, 0, 0, 0, 0.0078125, -0.0078125, 0.015625, 0, -0.0078125}}},
      {"orthographic", {LensModel::fisheye_orthographic}},
      {"equisolid", {LensModel::fisheye_equisolid}},
      {"unified", {LensModel::eucm, {0.75, 0.5}}},
      {"double sphere", {LensModel::double_sphere, {-0.25, 0.625}}},
      {"omnidirectional", {LensModel::omni, {0.75}}},
      {"omnidirectional and bent",
       {LensModel::omni, {0.75, -0.0625, 0.015625, 0.0078125, -0.015625}}},
      {"angle by a polynomial", {LensModel::ftheta, {-0.0625, 1, 0.125, -0.03125}}},
      {"equirectangular", {LensModel::equirectangular}},
      {"cylindrical", {LensModel::cylindrical}}};
}

Camera camera_with(const Lens& lens) {
  Camera camera = checks::camera_of(columns, rows, 12);
  camera.projection.lens = lens;
  return camera;
}

RenderOptions on_one_thread(std::vector<Channel> channels) {
  RenderOptions options;
  options.channels = std::move(channels);
  options.threads = 1;
  return options;
}

/// Without numbers of triangles and weights, which depend on the order of triangles and corners.
RenderOptions what_is_seen() {
  return on_one_thread({Channel::Z, Channel::N, Channel::P, Channel::distance, Channel::valid});
}

RenderOptions every_value() {
  return on_one_thread({Channel::Z, Channel::Zlow, Channel::N, Channel::P, Channel::distance,
                        Channel::id, Channel::bary, Channel::valid});
}

/// Calls `check` with each lens and some scenes.
template <class Check>
void for_each_view(std::uint64_t seed, int scenes, const Check& check) {
  std::mt19937_64 random(seed);
  for (const NamedLens& named : lenses()) {
    SCOPED_TRACE(named.name);
    for (int i = 0; i < std::max(1, scenes / checks::effort); ++i)
      check(camera_with(named.lens), soup_around_eye(random, 6), random);
  }
}

TEST(LensLaws, ALensWithoutDistortionGivesThePinholesMap) {
  std::mt19937_64 random(41);
  for (const LensModelEntry& entry : lens_models()) {
    if (!is_plane(entry.model)) continue;
    SCOPED_TRACE(entry.name);
    const Scene scene = soup_around_eye(random, 8);
    const Camera camera = camera_with(Lens{entry.model});
    Camera pinhole = camera;
    pinhole.projection.lens.reset();
    expect_same_map(render_tested(scene, camera, every_value()),
                    render_tested(scene, pinhole, every_value()));
  }
}

TEST(LensLaws, AModelGivesTheMapOfTheModelThatContainsIt) {
  const std::pair<Lens, Lens> same[] = {
      {{LensModel::simple_radial, {-0.25}}, {LensModel::radial, {-0.25}}},
      {{LensModel::radial, {-0.25, 0.125}}, {LensModel::opencv, {-0.25, 0.125}}},
      {{LensModel::opencv, {-0.25, 0.125, 0.01, 0.02}},
       {LensModel::full_opencv, {-0.25, 0.125, 0.01, 0.02}}},
      {{LensModel::full_opencv, {-0.25, 0.125, 0.01, 0.02, 0.1, 0.2, 0.1, 0.05}},
       {LensModel::opencv_14, {-0.25, 0.125, 0.01, 0.02, 0.1, 0.2, 0.1, 0.05}}},
      {{LensModel::opencv, {-0.25, 0.125, 0.01, 0.02}},
       {LensModel::brown, {-0.25, 0.125, 0, 0, 0.01, 0.02}}},
      {{LensModel::fov, {0.75}}, {LensModel::fov, {-0.75}}},
      {{LensModel::simple_division, {0.25}}, {LensModel::division, {0.25}}},
      {{LensModel::fisheye_stereographic}, {LensModel::division, {-0.25}}},
      {{LensModel::simple_fisheye}, {LensModel::fisheye}},
      {{LensModel::fisheye}, {LensModel::opencv_fisheye}},
      {{LensModel::simple_radial_fisheye, {-0.05}}, {LensModel::radial_fisheye, {-0.05}}},
      {{LensModel::radial_fisheye, {-0.05, 0.01}}, {LensModel::opencv_fisheye, {-0.05, 0.01}}},
      {{LensModel::opencv_fisheye, {-0.05, 0.01, 0.002, -0.001}},
       {LensModel::thin_prism_fisheye, {-0.05, 0.01, 0, 0, 0.002, -0.001}}},
      {{LensModel::opencv_fisheye, {-0.05, 0.01, 0.002, -0.001}},
       {LensModel::rad_tan_thin_prism_fisheye, {-0.05, 0.01, 0.002, -0.001}}},
      {{LensModel::thin_prism_fisheye, {0, 0, 0.01, 0.02, 0, 0, 0.03, -0.01}},
       {LensModel::rad_tan_thin_prism_fisheye, {0, 0, 0, 0, 0, 0, 0.02, 0.01, 0.03, 0, -0.01}}},
      {{LensModel::fisheye}, {LensModel::ftheta, {0, 1}}},
      {{LensModel::pinhole}, {LensModel::ucm, {0}}},
      {{LensModel::pinhole}, {LensModel::eucm, {0, 3}}},
      {{LensModel::pinhole}, {LensModel::omni, {0}}},
      {{LensModel::opencv, {-0.25, 0.125, 0.01, 0.02}},
       {LensModel::omni, {0, -0.25, 0.125, 0.01, 0.02}}},
      {{LensModel::ucm, {0.625}}, {LensModel::eucm, {0.625, 1}}},
      {{LensModel::fisheye_stereographic}, {LensModel::ucm, {0.5}}},
      {{LensModel::division, {-0.125}}, {LensModel::eucm, {0.5, 0.5}}},
      {{LensModel::fisheye_orthographic}, {LensModel::ucm, {1}}},
      {{LensModel::ucm, {0.625}}, {LensModel::double_sphere, {0, 0.625}}},
      {{LensModel::omni, {0.75}}, {LensModel::double_sphere, {0.75, 0}}}};
  std::mt19937_64 random(42);
  for (const auto& [special, general] : same) {
    SCOPED_TRACE(name_of(special.model));
    const Scene scene = soup_around_eye(random, 8);
    expect_same_map(render_tested(scene, camera_with(special), every_value()),
                    render_tested(scene, camera_with(general), every_value()));
  }
}

TEST(LensLaws, TheOrderOfTrianglesAndCornersChangesNothingThatIsSeen) {
  for_each_view(43, 5, [](const Camera& camera, Scene scene, std::mt19937_64& random) {
    const DepthMap before = render_tested(scene, camera, what_is_seen());
    auto& all = scene.meshes[0].triangles;
    std::shuffle(all.begin(), all.end(), random);
    for (CornerIndices& corners : all) std::shuffle(corners.begin(), corners.end(), random);
    expect_same_map(render_tested(scene, camera, what_is_seen()), before);
  });
}

// The middle of an edge is exact here.
TEST(LensLaws, SplittingATriangleChangesNothingThatIsSeen) {
  for_each_view(44, 5, [](const Camera& camera, const Scene& whole, std::mt19937_64&) {
    Scene split = whole;
    Mesh& mesh = split.meshes[0];
    mesh.triangles.clear();
    for (const CornerIndices& t : whole.meshes[0].triangles) {
      const MeshPoint a = mesh.vertices[t[0]], b = mesh.vertices[t[1]];
      const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
      mesh.triangles.push_back({t[0], middle, t[2]});
      mesh.triangles.push_back({middle, t[1], t[2]});
    }
    expect_same_map(render_tested(split, camera, what_is_seen()),
                    render_tested(whole, camera, what_is_seen()));
  });
}

TEST(LensLaws, ACropOfTheImageIsACropOfTheMap) {
  constexpr std::uint32_t left = 5, top = 4;
  for_each_view(45, 5, [](const Camera& camera, const Scene& scene, std::mt19937_64&) {
    Camera crop = camera;
    crop.width = 12;
    crop.height = 10;
    crop.projection.cx -= left;
    crop.projection.cy -= top;
    const DepthMap whole = render_tested(scene, camera, on_one_thread({Channel::distance}));
    const DepthMap part = render_tested(scene, crop, on_one_thread({Channel::distance}));
    const auto& all = *whole.values<float>("distance");
    const auto& cut = *part.values<float>("distance");
    for (std::uint32_t y = 0; y < crop.height; ++y)
      for (std::uint32_t x = 0; x < crop.width; ++x)
        ASSERT_EQ(cut[y * crop.width + x], all[(y + top) * columns + x + left]);
  });
}

TEST(LensLaws, MirroringTheWorldAndTheCameraChangesNothing) {
  for_each_view(46, 3, [](Camera camera, Scene scene, std::mt19937_64&) {
    const RenderOptions options = on_one_thread({Channel::Z, Channel::distance, Channel::id});
    const DepthMap before = render_tested(scene, camera, options);
    for (MeshPoint& p : scene.meshes[0].vertices) p.x = -p.x;
    for (auto& row : camera.world_to_camera) row[0] = -row[0];
    expect_same_map(render_tested(scene, camera, options), before);
  });
}

TEST(LensLaws, ThreadsChangeNothing) {
  for_each_view(47, 2, [](const Camera& camera, const Scene& scene, std::mt19937_64&) {
    RenderOptions options = every_value();
    const DepthMap before = render_tested(scene, camera, options);
    options.threads = 3;
    expect_same_map(render_tested(scene, camera, options), before);
  });
}

// Edges and diagonals of the box lie on the rays of samples: the eye is its centre, and the
// principal point a sample or the corner between four.
TEST(LensLaws, AClosedSurfaceAroundTheEyeCoversEveryRayOnce) {
  const Scene box = checks::box_scene(1, 1, 1);
  for (const NamedLens& named : lenses()) {
    SCOPED_TRACE(named.name);
    for (const double shift : {0.0, 0.5}) {
      for (const double sign : {1.0, -1.0}) {
        if (sign < 0 && is_panorama(named.lens.model)) continue;  // w > 0
        Camera camera = camera_with(named.lens);
        camera.projection.cx += shift;
        camera.projection.cy += shift;
        camera.projection.fx *= sign;
        if (has_one_focal_length(entry_of(named.lens.model)))
          camera.projection.fy = camera.projection.fx;
        const Rendered seen =
            checks::render_and_count(box, camera, on_one_thread({Channel::id, Channel::valid}));
        const auto& valid = *seen.map.values<std::uint32_t>("valid");
        const auto rays = static_cast<std::uint64_t>(std::ranges::count(valid, 1U));
        EXPECT_GT(rays, columns * rows / 4U);
        EXPECT_EQ(seen.statistics.pixels_with_surface, rays);
        if (checks::tested_engine() == Engine::reference) {
          EXPECT_EQ(seen.statistics.samples_covered, rays);  // not one is hit twice
        }
      }
    }
  }
}

/// A panorama of a full turn, with a sample on the seam, and on the poles of a sphere.
Camera full_panorama(LensModel model) {
  Camera camera;
  camera.width = 24;
  camera.height = 13;
  camera.projection = {.fx = 24, .fy = 12, .cx = 12, .cy = 6, .pixel_centre = 0};
  camera.projection.lens = Lens{model};
  return camera;
}

Scene octahedron() {
  return checks::scene_of(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

// Corners, edges and diagonals lie on rays at multiples of 45°, on the poles and on the seam.
TEST(LensLaws, AClosedSurfaceAroundTheEyeCoversAFullPanoramaOnce) {
  for (const LensModel model : {LensModel::equirectangular, LensModel::cylindrical}) {
    for (const Scene& scene : {checks::box_scene(1, 1, 1), octahedron()}) {
      for (const double pixel_centre : {0.0, 0.5}) {
        Camera camera = full_panorama(model);
        camera.projection.pixel_centre = pixel_centre;
        if (pixel_centre != 0) camera.height = 12;
        const Rendered seen = checks::render_and_count(scene, camera, on_one_thread({Channel::id}));
        const std::uint64_t samples = std::uint64_t{camera.width} * camera.height;
        EXPECT_EQ(seen.statistics.pixels_with_surface, samples) << name_of(model);
        if (checks::tested_engine() == Engine::reference) {
          EXPECT_EQ(seen.statistics.samples_covered, samples);
        }
      }
    }
  }
}

// A camera that turns by 90° about y sees along x what it saw along z. The samples lie at odd
// multiples of 7.5°, where no edge of few bits is.
TEST(LensLaws, AQuarterOfATurnShiftsAPanorama) {
  std::mt19937_64 random(48);
  for (const LensModel model : {LensModel::equirectangular, LensModel::cylindrical}) {
    for (int i = 0; i < 5; ++i) {
      const Scene scene = soup_around_eye(random, 10);
      Camera camera = full_panorama(model);
      camera.height = 12;
      camera.projection.pixel_centre = 0.5;
      const auto options = on_one_thread({Channel::distance, Channel::id});
      const DepthMap before = render_tested(scene, camera, options);
      const auto [x, y, z] = camera.world_to_camera;
      camera.world_to_camera = {z, y, {-x[0], -x[1], -x[2], -x[3]}};
      const DepthMap after = render_tested(scene, camera, options);
      const auto& distance = *before.values<float>("distance");
      const auto& shifted = *after.values<float>("distance");
      const auto &id = *before.values<std::uint32_t>("id"),
                 &shifted_id = *after.values<std::uint32_t>("id");
      for (std::uint32_t row = 0; row < camera.height; ++row) {
        for (std::uint32_t column = 0; column < camera.width; ++column) {
          const std::size_t from = row * camera.width + column;
          const std::size_t to = row * camera.width + (column + 6) % camera.width;
          ASSERT_EQ(shifted[to], distance[from]) << row << ' ' << column;
          ASSERT_EQ(shifted_id[to], id[from]) << row << ' ' << column;
        }
      }
    }
  }
}

}  // namespace
}  // namespace fathom
