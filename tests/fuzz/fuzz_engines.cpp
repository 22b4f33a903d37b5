// A scene from the bytes, by both engines: the maps must be the same, bit for bit.
#include "tests/fuzz/engine_inputs.h"

namespace fathom::fuzz {
namespace {

Scene scene_from(Bytes& bytes) {
  const int corners = 3 + bytes.below(12);
  std::vector<MeshPoint> vertices;
  for (int i = 0; i < corners; ++i) {
    const double x = bytes.coordinate(), y = bytes.coordinate(), z = bytes.coordinate();
    vertices.push_back({x, y, z});
  }
  std::vector<CornerIndices> triangles;
  while (!bytes.is_empty() && triangles.size() < 40) {
    const auto corner = [&] { return static_cast<std::uint32_t>(bytes.below(corners)); };
    const std::uint32_t a = corner(), b = corner(), c = corner();
    triangles.push_back({a, b, c});
  }
  return checks::scene_of(std::move(vertices), std::move(triangles));
}

}  // namespace
}  // namespace fathom::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  fuzz::Bytes bytes(data, size);
  const Camera camera = fuzz::camera_from(bytes);
  if (find_fault(camera)) return 0;
  const RenderOptions options = fuzz::options_from(bytes);
  fuzz::expect_same_maps(fuzz::scene_from(bytes), camera, options);
  return 0;
}
