// The study `lens`: published inverses against results of OpenCV, and each method against figures
// that can be derived on paper.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "apps/study/lens/lens_maps.h"
#include "apps/study/lens/lens_scene.h"
#include "fathom/failures/errors.h"
#include "fathom/lens/iterated_inverses.h"
#include "tests/places.h"

namespace fathom::studies {
namespace {

using lens::invert_as_colmap;
using lens::invert_by_fixed_point;

/// The corridor with a camera of fewer pixels.
SceneView small_corridor() {
  SceneView view = corridor();
  view.camera.width = 80;
  view.camera.height = 60;
  view.camera.projection.fx = view.camera.projection.fy = 60;
  view.camera.projection.cx = 40;
  view.camera.projection.cy = 30;
  return view;
}

Lens lens_called(const std::string& name, const Camera& camera, double strength = 1) {
  for (const StudiedLens& lens : lenses_for(camera))
    if (lens.name == name) return at_strength(lens.lens, strength);
  ADD_FAILURE() << "no lens " << name;
  return {};
}

/// Lines of numbers that another program has written.
std::vector<std::vector<double>> lines_of(const std::string& name) {
  std::ifstream file(test::source_dir() / "tests/validation/study" / name);
  std::vector<std::vector<double>> lines;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<double>& numbers = lines.emplace_back();
    for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  }
  return lines;
}

/// The stage whose lens has these first numbers.
lens::StageNumbers<double> stage_of(LensModel model, std::span<const double> numbers) {
  Lens lens{.model = model};
  std::copy(numbers.begin(), numbers.end(), lens.distortion.begin());
  return lens::stage_of(lens);
}

/// Bit for bit, since the operations are the same.
TEST(LensStudy, TheStepsAreOpenCVs) {
  const auto lines = lines_of("inverted_by_opencv.txt");
  EXPECT_EQ(lines.size(), 60U);
  for (const auto& n : lines) {
    ASSERT_EQ(n.size(), 18U);
    const auto stage = stage_of(LensModel::opencv_14, std::span(n).first(12));
    const PlanePoint y{n[12], n[13]};
    EXPECT_EQ(invert_by_fixed_point(stage, y, lens::steps_of_opencv), (PlanePoint{n[14], n[15]}));
    EXPECT_EQ(invert_by_fixed_point(stage, y, 20), (PlanePoint{n[16], n[17]}));
  }
}

/// But for the last bits, since COLMAP adds in another order.
TEST(LensStudy, NewtonsStepsAreCOLMAPs) {
  const auto lines = lines_of("inverted_by_colmap.txt");
  EXPECT_EQ(lines.size(), 80U);
  int without_ray = 0;
  for (const auto& n : lines) {
    ASSERT_EQ(n.size(), 9U);
    const auto found =
        invert_as_colmap(stage_of(LensModel::opencv, std::span(n).first(4)), {n[4], n[5]});
    ASSERT_EQ(found.has_value(), n[6] == 1);
    without_ray += found ? 0 : 1;
    if (!found) continue;
    EXPECT_NEAR((*found)[0], n[7], 1e-14);
    EXPECT_NEAR((*found)[1], n[8], 1e-14);
  }
  EXPECT_GT(without_ray, 3);
}

/// The last step is shorter than 10⁻⁵, and the error after it is about its square.
TEST(LensStudy, NewtonFindsTheExactRays) {
  const LensScene scene = in_camera_frame(small_corridor());
  for (const char* name : {"barrel", "pincushion", "decentred", "rational"}) {
    const LensView view(scene, lens_called(name, scene.pinhole, 0.8));
    for (std::size_t i = 0; i < view.exact().rays.size(); ++i) {
      const auto found = invert_as_colmap(view.stage(), view.distorted_point(i));
      ASSERT_TRUE(found) << name;
      EXPECT_NEAR((*found)[0], view.exact().rays[i][0], 1e-9) << name;
      EXPECT_NEAR((*found)[1], view.exact().rays[i][1], 1e-9) << name;
    }
  }
}

/// Beyond the fold r + k·r³ = 1, where no ray is: the steps go to and fro about r = 1.5.
TEST(LensStudy, NewtonFindsNothingBeyondTheFold) {
  const auto stage = stage_of(LensModel::simple_radial, std::array{-4.0 / 27});
  EXPECT_TRUE(invert_as_colmap(stage, {0.999, 0}));
  EXPECT_FALSE(invert_as_colmap(stage, {1.001, 0}));
  // OpenCV's steps end somewhere.
  EXPECT_GT(invert_by_fixed_point(stage, {1.001, 0}, 20)[0], 1.3);
}

TEST(LensStudy, TheExactMapHasNoErrors) {
  const LensScene scene = in_camera_frame(small_corridor());
  for (const char* name : {"barrel", "pincushion", "decentred", "rational"}) {
    const LensView view(scene, lens_called(name, scene.pinhole, 0.8));
    const LensErrors errors = errors_of(view.exact(), view);
    EXPECT_EQ(errors.rays, 4800U);
    EXPECT_GT(errors.surface_pixels, 4000U);
    EXPECT_LT(errors.greatest.value(), 1e-12);
    EXPECT_EQ(errors.wrong_surface() + errors.beyond + errors.invented_rays, 0U);
    EXPECT_EQ(errors.greatest_depth, 0);
  }
}

/// A rectangle that faces the camera: its corners lie equally far from the axis, so that bending
/// them makes it larger or smaller, and an error is that of one radius.
TEST(LensStudy, TheErrorOfABentRectangleIsKnown) {
  constexpr double k = -0.2, x = 0.4, y = 0.31, f = 100;
  SceneView view{"rectangle", {}, {}};
  Mesh mesh;
  mesh.vertices = {{-x, -y, 1}, {x, -y, 1}, {x, y, 1}, {-x, y, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  view.scene.meshes = {mesh};
  view.scene.objects = {{.name = "rectangle"}};
  view.camera.width = view.camera.height = 100;
  view.camera.projection.fx = view.camera.projection.fy = f;
  view.camera.projection.cx = view.camera.projection.cy = 50;
  const LensScene scene = in_camera_frame(view);
  Lens lens{.model = LensModel::simple_radial};
  lens.distortion[0] = k;

  const double scale = 1 + k * (x * x + y * y);
  double greatest = 0;
  std::uint64_t inside = 0;
  for (double u = 0.5; u < 100; ++u) {
    for (double v = 0.5; v < 100; ++v) {
      const double X = (u - 50) / f / scale, Y = (v - 50) / f / scale, q = X * X + Y * Y;
      if (std::abs(X) > x || std::abs(Y) > y) continue;
      ++inside;
      greatest = std::max(greatest, f * std::sqrt(q) * std::abs(1 + k * q - scale));
    }
  }
  const LensView through(scene, lens);
  const BentMap map = map_by_vertices(through, bend_vertices(through, 1));
  const LensErrors errors = errors_of(map.shown, through);
  EXPECT_NEAR(errors.greatest.value(), greatest, 1e-9);
  EXPECT_GT(greatest, 0.5);
  EXPECT_NEAR(map.longest_edge, 2 * f * std::hypot(x, y) * scale, 1e-9);
  EXPECT_EQ(errors.surface_pixels - errors.missing + errors.invented, inside);
  EXPECT_LT(errors.greatest_depth, 1e-15);

  // Half the edges, a quarter of the error.
  const auto greatest_of = [&](int parts) {
    return *errors_of(map_by_vertices(through, bend_vertices(through, parts)).shown, through)
                .greatest;
  };
  EXPECT_NEAR(greatest_of(8) / greatest_of(16), 4, 0.4);
}

/// Pieces are numbered within their triangles, so surfaces and depths are right: a mesh as fine as
/// pixels shows the exact map except beside edges.
TEST(LensStudy, AFineMeshIsRight) {
  const LensScene scene = in_camera_frame(small_corridor());
  const LensView view(scene, lens_called("pincushion", scene.pinhole, 0.5));
  const LensErrors errors = errors_of(map_by_vertices(view, bend_vertices(view, 64)).shown, view);
  EXPECT_LT(errors.greatest.value(), 0.01);
  EXPECT_LT(errors.greatest_depth, 0.001);
  EXPECT_LT(errors.wrong_surface(), 10U);
}

/// A barrel lens makes distances smaller, so half a pixel's diagonal remains the greatest error.
TEST(LensStudy, TheNearestPixelIsHalfAPixelOff) {
  const LensScene scene = in_camera_frame(small_corridor());
  const LensView view(scene, lens_called("barrel", scene.pinhole, 0.5));
  const LensErrors errors = errors_of(map_by_lookup(view, Lookup::nearest), view);
  EXPECT_LT(errors.greatest.value(), std::sqrt(0.5));
  EXPECT_GT(errors.greatest.value(), 0.6);
  EXPECT_GT(errors.wrong_surface(), 0U);
}

/// Where the depth is the same everywhere, a mean of depths is right; beside edges surfaces mix.
TEST(LensStudy, AMeanOfPixelsIsRightOnASurfaceOfOneDepth) {
  SceneView view = small_corridor();
  std::erase_if(view.scene.objects, [](const Object& object) { return object.name != "back"; });
  const LensScene scene = in_camera_frame(view);
  const LensView through(scene, lens_called("barrel", scene.pinhole, 0.5));
  const ShownMap shown = map_by_lookup(through, Lookup::bilinear);
  const LensErrors errors = errors_of(shown, through);
  EXPECT_FALSE(errors.greatest);
  EXPECT_LT(errors.greatest_depth, 1e-14);
  EXPECT_GT(errors.missing, 0U);
  EXPECT_LT(errors.missing, errors.surface_pixels / 4);

  const LensScene all = in_camera_frame(small_corridor());
  const LensView corridor_view(all, lens_called("barrel", all.pinhole, 0.5));
  const ShownMap mixed = map_by_lookup(corridor_view, Lookup::bilinear);
  EXPECT_GT(std::ranges::count(mixed.surfaces, mixed_surfaces), 100);
}

TEST(LensStudy, OtherLensesAreRefused) {
  Camera camera = corridor().camera;
  camera.projection.lens = Lens{.model = LensModel::fisheye_equisolid};
  EXPECT_THROW(lenses_for(camera), UsageError);
  camera.projection.lens = Lens{.model = LensModel::opencv_14, .distortion = {0.1}};
  EXPECT_EQ(lenses_for(camera).size(), 1U);
  camera.projection.lens->distortion[12] = 0.01;
  EXPECT_THROW(lenses_for(camera), UsageError);
}

}  // namespace
}  // namespace fathom::studies
