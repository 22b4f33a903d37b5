// Channels that are written to memory of the caller's: every value of it is written.
#include <gtest/gtest.h>

#include <map>

#include "tests/engines/expect_same_map.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using testing::CaseMaker;
using testing::every_channel;
using testing::expect_same_map;
using testing::Kind;

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

void expect_same_in_lent_memory(const Scene& scene, const Camera& camera, RenderOptions options) {
  const auto render = [&] {
    return options.engine == Engine::fast ? render_fast(scene, camera, options)
                                          : render_reference(scene, camera, options);
  };
  options.memory = nullptr;
  const DepthMap expected = render();
  Lender lender(camera);
  options.memory = [&](const std::string& channel) { return lender(channel); };
  const DepthMap found = render();
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

TEST(LentMemory, IsOfTheMapsOwnWhereNoneIsLent) {
  CaseMaker cases(1, Kind::few_bits);
  const auto [scene, camera] = cases.make();
  RenderOptions options;
  const DepthMap expected = render_fast(scene, camera, options);
  options.memory = [](const std::string&) -> void* { return nullptr; };
  expect_same_map(render_fast(scene, camera, options), expected);
}

}  // namespace
}  // namespace fathom
