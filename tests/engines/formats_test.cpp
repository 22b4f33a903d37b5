// The same mesh in every format, and in every variant of each, gives the same map bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>

#include "fathom/camera/camera_making.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/oracle/against_oracle.h"
#include "tests/places.h"

namespace fathom {
namespace {

/// All values of all channels as bits, channel by channel.
std::vector<std::uint32_t> bits_of(const DepthMap& map) {
  std::vector<std::uint32_t> bits;
  for (const ImageChannel& channel : map.channels) {
    if (const auto* floats = std::get_if<Samples<float>>(&channel.values)) {
      for (const float x : *floats) bits.push_back(std::bit_cast<std::uint32_t>(x));
    } else {
      const auto& integers = std::get<Samples<std::uint32_t>>(channel.values);
      bits.insert(bits.end(), integers.begin(), integers.end());
    }
  }
  return bits;
}

std::vector<std::uint32_t> rendered(const Scene& scene, const Camera& camera) {
  RenderOptions options;
  options.channels = checks::all_channels();
  options.normals = NormalSource::place;  // formats differ in what vertices are shared
  return bits_of(checks::render_tested(scene, camera, options));
}

Camera small_camera(const Scene& scene) {
  LensChoice lens;
  lens.width = 48;
  lens.height = 32;
  return frame_scene(scene, {}, lens);
}

TEST(Formats, EveryVariantGivesTheSameMap) {
  const auto scene_of_mesh = [](const Mesh& mesh) {
    Scene scene;
    scene.meshes.push_back(mesh);
    scene.objects.push_back({.name = "sample"});
    return scene;
  };
  const Mesh truth = test::sample_mesh();
  const Camera camera = small_camera(scene_of_mesh(truth));
  const std::vector<std::uint32_t> expected = rendered(scene_of_mesh(truth), camera);
  for (const test::MeshFile& file : test::variants_of(truth)) {
    Warnings warnings;
    EXPECT_EQ(rendered(scene_of_mesh(test::read_variant(file, warnings)), camera), expected)
        << file.name;
  }
}

TEST(Formats, EveryCubeOfTheDataGivesTheSameMap) {
  const std::filesystem::path folder = test::source_dir() / "data/meshes";
  const auto read = [&](const std::string& name) {
    Warnings warnings;
    return read_scene({folder / name}, {}, warnings);
  };
  const Camera camera = small_camera(read("cube.obj"));
  const std::vector<std::uint32_t> expected = rendered(read("cube.obj"), camera);
  int formats = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("cube")) continue;
    ++formats;
    EXPECT_EQ(rendered(read(name), camera), expected) << name;
  }
  EXPECT_EQ(formats, 10);
}

}  // namespace
}  // namespace fathom
