#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/render.h"
#include "validation/colour/colour_comparison.h"
#include "validation/embree/embree_tracer.h"
#include "validation/scenes/shapes.h"
#include "validation/vtk/drawn_by_vtk.h"
#include "validation/vtk/vtk_renderer.h"

/// VTK and Embree see what we see, through a camera with everything that a camera has. Built where
/// they are (FATHOM_PEERS).
namespace fathom::validation {
namespace {

using attribution::clip_range;
using attribution::ClipRange;
using attribution::world_mesh;
using attribution::WorldMesh;

Camera odd_camera(ProjectionModel projection) {
  Camera camera{.width = 160, .height = 90, .projection = {.model = projection}};
  const bool perspective = projection == ProjectionModel::perspective;
  camera.projection.fx = perspective ? 150 : 30;
  camera.projection.fy = perspective ? -130 : -28;  // mirrored
  camera.projection.cx = 70.25;
  camera.projection.cy = 48.5;
  camera.projection.skew = perspective ? 12 : 3;
  camera.projection.pixel_centre = 0;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.1}, {-0.1, 1.1, 0.3, -0.2}, {0.2, -0.3, 0.8, 4}}};
  return camera;
}

struct Difference {
  std::size_t coverage = 0;
  double depth = 0;
};

/// Pixels that only one of the two covers, and the greatest difference of depth elsewhere.
Difference difference(const Samples<float>& ours, const std::vector<float>& theirs) {
  Difference found;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (std::isinf(ours[i]) != std::isinf(theirs[i])) {
      ++found.coverage;
    } else if (!std::isinf(ours[i])) {
      found.depth = std::max(found.depth, std::abs(double{ours[i]} - theirs[i]));
    }
  }
  return found;
}

class Peers : public testing::TestWithParam<ProjectionModel> {
 protected:
  const Camera camera = odd_camera(GetParam());
  const Scene scene = bench::as_scene({bench::sphere(800)}, "sphere");
  const WorldMesh mesh = world_mesh(scene);
  const DepthMap map = render(scene, camera, {.engine = Engine::fast}).map;
  const Samples<float>& ours = *map.values<float>("Z");
};

// Both compute positions in binary32, off by a few ulp of 160 pixels (2⁻¹⁵ pixel), and VTK snaps
// corners to 2⁻⁸ pixel. So one sample in about 2⁸ of those whose pixel the outline passes, fewer
// than 400, may be covered differently: 2 at most. A pixel is 0.03 units wide here, so depths of a
// facet of slope k differ by 0.03·k·2⁻⁸ for VTK and by 2⁻⁷ of that for Embree, besides the rounding
// of the depth, 2⁻²²: the limits allow k = 150 and more, facets within 0.4° of edge-on, which are
// narrower than a tenth of a pixel. A camera read wrongly in one sign differs in 400 pixels and by
// 0.3 units.
TEST_P(Peers, VtkSeesTheSame) {
  const ClipRange range = clip_range(mesh, camera);
  VtkRenderer renderer(mesh, camera, range);
  renderer.draw();
  std::vector<float> depths = renderer.window_depths();
  for (float& depth : depths) {
    const double z = depth, length = range.far - range.near;
    depth = depth == 1 ? INFINITY
            : is_perspective(camera.projection)
                ? static_cast<float>(range.near * range.far / (range.far - z * length))
                : static_cast<float>(range.near + z * length);
  }
  const Difference found = difference(ours, depths);
  EXPECT_LE(found.coverage, 2U);
  EXPECT_LE(found.depth, 0.02);
}

// Otherwise z-fighting would be counted of another drawing than the one that is judged.
TEST_P(Peers, VtkDrawsTheSameDepthsWithNumbers) {
  const ClipRange range = clip_range(mesh, camera);
  const auto drawn = [&](VtkOptions options, bool numbers) {
    options.numbers = numbers;
    VtkRenderer renderer(mesh, camera, range, options);
    renderer.draw();
    return renderer.drawing();
  };
  for (const VtkOptions& options :
       {VtkOptions{}, VtkOptions{.depth = Storage::unorm16}, VtkOptions{.depth = Storage::unorm24},
        VtkOptions{.depth = Storage::float32}, VtkOptions{.samples = 4},
        VtkOptions{.depth = Storage::float32, .reversed = true}}) {
    const VtkDrawing plain = drawn(options, false), numbered = drawn(options, true);
    EXPECT_EQ(plain.windows, numbered.windows);
    EXPECT_EQ(plain.shift, numbered.shift);
    EXPECT_EQ(plain.clip_from_held, numbered.clip_from_held);
    EXPECT_TRUE(plain.triangles.empty());
    const double cleared = options.reversed ? 0 : 1;
    ASSERT_EQ(numbered.triangles.size(), numbered.windows.size());
    for (std::size_t i = 0; i < numbered.windows.size(); ++i) {
      ASSERT_EQ(numbered.triangles[i] == no_surface, numbered.windows[i] == cleared) << i;
    }
  }
}

// The number is that of the exact map where one triangle alone is near: a ball's outline and edges
// are the rest.
TEST_P(Peers, VtkNumbersTrianglesAsWeDo) {
  VtkRenderer renderer(mesh, camera, clip_range(mesh, camera), {.numbers = true});
  renderer.draw();
  const std::vector<std::uint32_t> theirs = renderer.drawing().triangles;
  const DepthMap exact = render(scene, camera, {.channels = {Channel::id}}).map;
  const auto& ids = *exact.values<std::uint32_t>("id");
  std::size_t differing = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) differing += ids[i] != theirs[i] ? 1 : 0;
  EXPECT_LT(differing, ids.size() / 200);
}

/// Exercise 3 of the course with the nearer sheet first: two oblique sheets, one 0.0001 behind the
/// other.
WorldMesh two_sheets(double distance) {
  const double d = distance, s = distance / 3;
  WorldMesh sheets;
  for (const double behind : {0.0, 0.0001}) {
    for (const auto& [x, y, z] : {std::array{-s, -s, d}, std::array{s, -s, d * 1.2},
                                  std::array{s, s, d * 1.4}, std::array{-s, s, d * 1.2}}) {
      sheets.points.push_back({x * (z + behind) / z, y * (z + behind) / z, z + behind});
    }
  }
  sheets.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return sheets;
}

// validation/vtk/count_wrong_surfaces.py, which shares nothing with the adaptor, counts the same.
// Depths of 16 bits are all equal there, and the later sheet wins wherever it is drawn.
TEST(VtkNumbers, ShowTheWrongSheetsThatAScriptCounts) {
  Camera camera{.width = 96, .height = 96};
  camera.projection.fx = camera.projection.fy = 96;
  camera.projection.cx = camera.projection.cy = 48;
  camera.near = 0.001;
  camera.far = 1000;
  for (const auto& [distance, wrong] : {std::pair{2.0, 2610}, {10.0, 2874}}) {
    const WorldMesh sheets = two_sheets(distance);
    for (const auto& [attachment, expected] : {std::pair{std::optional<Storage>(), wrong},
                                               {std::optional(Storage::unorm16), 2931},
                                               {std::optional(Storage::unorm24), wrong},
                                               {std::optional(Storage::unorm32), wrong},
                                               {std::optional(Storage::float32), wrong}}) {
      const DrawnMap drawn = draw_vtk(sheets, camera, {.attachment = attachment});
      EXPECT_EQ(drawn.model.equal_depths, EqualDepths::last_wins);
      const auto& seen = drawn.map.triangles;
      EXPECT_EQ(
          std::count_if(seen.begin(), seen.end(), [](std::uint32_t t) { return t == 2 || t == 3; }),
          expected)
          << distance << " " << (attachment ? name_of(*attachment) : "own");
    }
  }
}

TEST_P(Peers, EmbreeSeesTheSame) {
  EmbreeTracer tracer(mesh, {.robust = true, .threads = 1});
  tracer.build();
  for (const RayStream stream : {RayStream::packets, RayStream::arrays}) {
    std::vector<float> depths;
    tracer.trace(camera, stream, depths);
    const Difference found = difference(ours, depths);
    EXPECT_LE(found.coverage, 2U);
    EXPECT_LE(found.depth, 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Peers,
                         testing::Values(ProjectionModel::perspective,
                                         ProjectionModel::orthographic),
                         [](const auto& projection) {
                           return projection.param == ProjectionModel::perspective ? "Perspective"
                                                                                   : "Orthographic";
                         });

/// A ball of 800 triangles, lit, before a camera that sees all of it.
LitScene lit_ball() {
  Camera camera;
  camera.width = 96;
  camera.height = 72;
  camera.projection.fx = camera.projection.fy = 90;
  camera.projection.cx = 48;
  camera.projection.cy = 36;
  camera.world_to_camera[2][3] = 4;
  camera.near = 1;
  camera.far = 10;
  return lit_scene(bench::as_scene({bench::sphere(800)}, "sphere"), camera,
                   {.ambient = 0.15,
                    .diffuse = 0.6,
                    .specular = 0.25,
                    .shininess = 40,
                    .highlight = pipeline::SpecularModel::phong});
}

/// Pixels of a picture of VTK's that are not explained.
std::size_t unexplained(const LitScene& scene, const GreyPicture& picture, LightModel model) {
  const Drawn drawn{&picture, model, vtk_on_llvmpipe};
  const ColourComparison found = compare_colours(scene, drawn, drawn);
  EXPECT_GT(found.inside + found.unexplained.size(), 1000U);
  return found.unexplained.size();
}

// VTK's Gouraud is its Phong: a picture of light at the corners is another one.
TEST(PeersColours, AreThoseOfTheFormulasAndNoOthers) {
  const LitScene scene = lit_ball();
  const GreyPicture flat = draw_vtk_colours(scene, VtkShading::flat);
  const GreyPicture gouraud = draw_vtk_colours(scene, VtkShading::gouraud);
  const GreyPicture phong = draw_vtk_colours(scene, VtkShading::phong);
  EXPECT_EQ(gouraud.codes, phong.codes);
  EXPECT_EQ(unexplained(scene, phong, LightModel::interpolated_normal), 0U);
  EXPECT_EQ(unexplained(scene, flat, LightModel::derived_normal), 0U);
  EXPECT_GT(unexplained(scene, gouraud, LightModel::corners), 100U);
  EXPECT_GT(unexplained(scene, phong, LightModel::derived_normal), 100U);
  EXPECT_GT(unexplained(scene, flat, LightModel::interpolated_normal), 100U);

  LitScene turned = scene;  // by 0.6°
  turned.towards_light[0] += 0.01;
  EXPECT_GT(unexplained(turned, phong, LightModel::interpolated_normal), 100U);
  LitScene duller = scene;
  duller.material.shininess = 36;
  EXPECT_GT(unexplained(duller, phong, LightModel::interpolated_normal), 20U);
  LitScene shifted = scene;
  shifted.camera.projection.cx += 0.05;
  EXPECT_GT(unexplained(shifted, phong, LightModel::interpolated_normal), 20U);
}

}  // namespace
}  // namespace fathom::validation
