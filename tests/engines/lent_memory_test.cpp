// Channels that are written to memory of the caller's: every value of it is written.
#include <gtest/gtest.h>

#include <map>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using checks::CaseMaker;
using checks::every_channel;
using checks::expect_same_map;
using checks::Kind;

/// Memory for channels, full of what no map has.
class Lender {
 public:
  explicit Lender(const Camera& camera)
      : bytes_(std::size_t{camera.width} * camera.height * sizeof(double)) {}
  void* operator()(const std::string& channel) {
    std::vector<std::byte>& memory = lent_[channel];
    memory.assign(bytes_, std::byte{0x5b});
    return memory.data();
  }
  [[nodiscard]] bool has_lent(const void* data) const {
    return std::any_of(lent_.begin(), lent_.end(),
                       [&](const auto& each) { return each.second.data() == data; });
  }

 private:
  std::size_t bytes_;
  std::map<std::string, std::vector<std::byte>> lent_;
};

void expect_same_in_lent_memory(const Scene& scene, const Camera& camera,
                                const RenderOptions& options) {
  const auto render = [&](const RenderContext& context) {
    return options.engine == Engine::fast ? render_fast(scene, camera, options, context).map
                                          : render_reference(scene, camera, options, context).map;
  };
  const DepthMap expected = render({});
  Lender lender(camera);
  const DepthMap found =
      render({.memory = [&](const std::string& channel) { return lender(channel); }});
  expect_same_map(found, expected);
  for (const ImageChannel& channel : found.channels)
    std::visit([&](const auto& values) { EXPECT_TRUE(lender.has_lent(values.data())); },
               channel.values);
}

TEST(LentMemory, HoldsTheSameMapInEveryEncoding) {
  CaseMaker cases(20, Kind::few_bits);
  for (int i = 0; i < 20; ++i) {
    const auto [scene, camera] = cases.make();
    for (const Engine engine : {Engine::fast, Engine::reference}) {
      RenderOptions options;
      options.engine = engine;
      options.channels = every_channel;
      expect_same_in_lent_memory(scene, camera, options);
      options.channels = {Channel::Z};
      expect_same_in_lent_memory(scene, camera, options);
      options.depth_encoding.type = StoredType::binary64;
      options.channels = {Channel::Z, Channel::distance};
      expect_same_in_lent_memory(scene, camera, options);
    }
  }
}

/// Addresses of all channels.
std::map<std::string, const void*> places_of(const DepthMap& map) {
  std::map<std::string, const void*> places;
  for (const ImageChannel& channel : map.channels) {
    std::visit([&](const auto& values) { places[channel.name] = values.data(); }, channel.values);
  }
  return places;
}

/// One map and one memory for scenes, sizes, engines, channels and encodings in turn: what was
/// there never shows, and what has the same name, type and size stays where it is.
TEST(RenderInto, GivesTheMapOfRenderWhereTheChannelsWereBefore) {
  CaseMaker cases(21, Kind::few_bits);
  RenderMemory memory;
  Rendered rendered;
  const DepthMap& map = rendered.map;
  rendered.map.texts["left"] = "over";
  for (int i = 0; i < 24; ++i) {
    const auto [scene, camera] = cases.make();
    RenderOptions options;
    options.engine = i % 5 == 4 ? Engine::reference : Engine::fast;
    options.channels = i % 3 == 0 ? std::vector{Channel::Z} : every_channel;
    if (i % 4 == 3) options.depth_encoding.type = StoredType::binary64;
    if (i % 2 == 0) options.threads = 1;
    const DepthMap expected = render(scene, camera, options).map;
    const std::size_t pixels = std::size_t{map.width} * map.height;
    const bool same_size = std::size_t{camera.width} * camera.height == pixels;
    for (const bool again : {false, true}) {
      const auto before = places_of(map);
      render_into(rendered, scene, camera, options, {.kept = &memory});
      expect_same_map(map, expected);
      EXPECT_EQ(texts_of(map), texts_of(expected));
      if (!again && !same_size) continue;
      const auto now = places_of(map);
      for (const auto& [name, place] : now) {
        const auto found = before.find(name);
        // Depths may have been of another type.
        const bool may_differ = !again && (name == "Z" || name == "distance");
        if (found == before.end() || may_differ) continue;
        EXPECT_EQ(place, found->second) << name;
      }
    }
  }
}

/// Each frame by another thread, and of another mesh.
TEST(RenderInto, WorksWithMemoryThatOtherThreadsHaveUsed) {
  CaseMaker cases(23, Kind::few_bits);
  RenderMemory memory;
  for (int i = 0; i < 12; ++i) {
    const checks::Case one = cases.make();
    RenderOptions options;
    const DepthMap expected = render(one.scene, one.camera, options).map;
    Rendered rendered;
    std::thread([&] {
      render_into(rendered, one.scene, one.camera, options, {.kept = &memory});
    }).join();
    expect_same_map(rendered.map, expected);
  }
}

TEST(RenderInto, LeavesAnEmptyMapWhereItFails) {
  CaseMaker cases(22, Kind::few_bits);
  auto [scene, camera] = cases.make();
  RenderMemory memory;
  const RenderOptions options;
  const RenderContext context{.kept = &memory};
  Rendered rendered = render(scene, camera, options, context);
  Scene broken = scene;
  broken.meshes[0].triangles[0][0] = static_cast<std::uint32_t>(broken.meshes[0].vertices.size());
  EXPECT_THROW(render_into(rendered, broken, camera, options, context), InputError);
  EXPECT_TRUE(rendered.map.channels.empty());
  render_into(rendered, scene, camera, options, context);
  expect_same_map(rendered.map, render(scene, camera).map);
}

TEST(LentMemory, IsOfTheMapsOwnWhereNoneIsLent) {
  CaseMaker cases(1, Kind::few_bits);
  const auto [scene, camera] = cases.make();
  const RenderContext none{.memory = [](const std::string&) -> void* { return nullptr; }};
  expect_same_map(render_fast(scene, camera, {}, none).map, render_fast(scene, camera, {}).map);
}

}  // namespace
}  // namespace fathom
