// Every scene of data/scenes/hard against rays cast in rational numbers, every channel of every
// pixel. A case that once was wrong, or easily could be, stands there under a name.
#include <gtest/gtest.h>

#include <filesystem>

#include "fathom/camera/camera_files.h"
#include "fathom/scene/read_scene.h"
#include "tests/engines/tested_engine.h"
#include "tests/oracle/against_oracle.h"
#include "tests/places.h"

namespace fathom {
namespace {

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_dir() / "data/scenes/hard")) {
    if (entry.path().extension() == ".obj") found.push_back(entry.path().stem().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

class HardScene : public ::testing::TestWithParam<std::string> {};

TEST_P(HardScene, AgreesWithRays) {
  const std::filesystem::path folder = test::source_dir() / "data/scenes/hard";
  Warnings warnings;
  const Scene scene = read_scene({folder / (GetParam() + ".obj")}, {}, warnings);
  int seen = 0;
  for (const Camera& camera : read_cameras(folder / (GetParam() + ".camera.json"))) {
    RenderOptions options;
    options.channels = checks::all_channels();
    const DepthMap map = checks::render_tested(scene, camera, options);
    seen += checks::expect_as_rays(map, scene, camera);
  }
  EXPECT_GT(seen, 0);
}

INSTANTIATE_TEST_SUITE_P(Data, HardScene, ::testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace fathom
