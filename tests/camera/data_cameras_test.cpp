// The cameras in data/, of our own format and of others.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "tests/camera/seen_points.h"
#include "tests/places.h"

namespace fathom {
namespace {

using namespace test;

/// The corners of data/meshes/spot.obj.
std::vector<Vector> spot() {
  std::ifstream file(source_dir() / "data/meshes/spot.obj");
  std::vector<Vector> corners;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    double x = 0, y = 0, z = 0;
    if (words >> kind >> x >> y >> z && kind == "v") corners.push_back({x, y, z});
  }
  return corners;
}

TEST(DataCameras, AllSeeTheWholeCow) {
  const auto corners = spot();
  ASSERT_EQ(corners.size(), 2930U);
  const std::filesystem::path folder = source_dir() / "data/cameras";
  std::vector<ImportedCamera> cameras;
  for (const char* name : {"look-at", "orthographic", "calibrated", "opencv", "orbit", "colmap"})
    for (const Camera& camera : read_cameras(folder / (std::string(name) + ".json")))
      cameras.push_back({.camera = camera});
  Warnings warnings;
  for (const auto& list :
       {import_colmap(folder / "colmap"), import_nerf(folder / "transforms.json", 0, 0, warnings),
        import_bop(folder / "scene_camera.json", 640, 480), import_opengl(folder / "opengl.json")})
    cameras.insert(cameras.end(), list.begin(), list.end());
  EXPECT_EQ(cameras.size(), 4U + 4 + 2 + 2 + 2 + 2 + 2);
  for (const ImportedCamera& one : cameras) {
    const Camera& camera = one.camera;
    EXPECT_EQ(one.fault + one.absence + one.distortion, "");
    for (const Vector& corner : corners) {
      const Seen at = seen(camera, corner);
      ASSERT_GT(at.depth, 1) << camera.name;
      ASSERT_TRUE(at.u > 0 && at.u < camera.width && at.v > 0 && at.v < camera.height)
          << camera.name << " " << at.u << " " << at.v;
    }
  }
}

TEST(DataCameras, TheSameCameraInFourFormatsIsTheSame) {
  const std::filesystem::path folder = source_dir() / "data/cameras";
  Warnings warnings;
  const Camera colmap = import_colmap(folder / "colmap").at(0).camera;
  const Camera nerf = import_nerf(folder / "transforms.json", 0, 0, warnings).at(0).camera;
  const Camera bop = import_bop(folder / "scene_camera.json", 640, 480).at(0).camera;
  const Camera opengl = import_opengl(folder / "opengl.json").at(0).camera;
  for (const Vector& corner : spot()) {
    const Seen at = seen(colmap, corner);
    expect_same(seen(nerf, corner), at);
    expect_same(seen(bop, corner), at);
    expect_same(seen(opengl, corner), at);
  }
}

}  // namespace
}  // namespace fathom
