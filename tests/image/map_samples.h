#pragma once

#include <unistd.h>

#include <bit>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "fathom/image/depth_map.h"

/// Maps to try things on.
namespace fathom::checks {

inline constexpr float inf = std::numeric_limits<float>::infinity();

/// A folder that is gone when the test is.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "fathom-image-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The bits of a channel, whatever its type.
inline std::vector<std::uint64_t> bits_of(const ImageChannel& channel) {
  return std::visit(
      [](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        std::vector<std::uint64_t> bits;
        for (const Value value : values) {
          if constexpr (std::is_same_v<Value, float>)
            bits.push_back(std::bit_cast<std::uint32_t>(value));
          else if constexpr (std::is_same_v<Value, double>)
            bits.push_back(std::bit_cast<std::uint64_t>(value));
          else
            bits.push_back(value);
        }
        return bits;
      },
      channel.values);
}

inline constexpr std::uint64_t seed = 20261121;

/// All bit patterns are possible: NaNs with payloads (signalling ones too), infinities, −0,
/// subnormals, and long runs, as depth maps have them.
template <class T>
std::vector<T> random_bits(std::size_t count, std::uint64_t salt) {
  std::mt19937_64 random(seed + salt);
  std::vector<T> values(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t bits = random();
    if (k > 0 && bits % 3 == 0) {
      values[k] = values[k - 1];
      continue;
    }
    if constexpr (sizeof(T) == 8)
      values[k] = std::bit_cast<T>(random());
    else if constexpr (sizeof(T) == 4)
      values[k] = std::bit_cast<T>(static_cast<std::uint32_t>(bits >> 32));
    else
      values[k] = static_cast<T>(bits >> 48);
  }
  return values;
}

inline std::vector<float> awkward_floats() {
  using Limits = std::numeric_limits<float>;
  return {0.0f,
          -0.0f,
          Limits::denorm_min(),
          -Limits::denorm_min(),
          Limits::max(),
          Limits::infinity(),
          -Limits::infinity(),
          std::bit_cast<float>(0x7FC00001u),
          std::bit_cast<float>(0x7F800001u),
          std::bit_cast<float>(0xFFFFFFFFu)};
}

inline DepthMap map_of(std::uint32_t width, std::uint32_t height, const std::string& name,
                       decltype(ImageChannel::values) values) {
  DepthMap map;
  map.width = width;
  map.height = height;
  map.channels.push_back({name, std::move(values)});
  return map;
}

/// Random bits in channels of both types that EXR has, and everything that a map carries.
inline DepthMap full_map(std::uint32_t width, std::uint32_t height) {
  const std::size_t count = std::size_t{width} * height;
  std::vector<float> z = random_bits<float>(count, 1);
  const std::vector<float> awkward = awkward_floats();
  for (std::size_t k = 0; k < std::min(count, awkward.size()); ++k) z[k] = awkward[k];
  DepthMap map = map_of(width, height, "Z", std::move(z));
  map.channels.push_back({"N.X", random_bits<float>(count, 2)});
  map.channels.push_back({"object", random_bits<std::uint32_t>(count, 3)});
  map.channels.push_back({"id", random_bits<std::uint32_t>(count, 4)});
  map.object_names = {"spot", "wall \"é\"", ""};
  map.tables = {{"material", {"oak", std::string("a\0b", 3), "ひ"}}, {"part", {"lid"}}};
  map.texts = {{"fathom.camera", "{\"width\": 3}"}, {"fathom.engine", "reference"}};
  map.numbers = {{"worldToCamera", {1, 5, 9, 0, 2, 6, 10, 0, 3, 7, 11, 0, 4, 8, 12, 1}},
                 {"worldToNDC", {0.5, 0, 0, 0, 0, 0.25, 0, 0, 0.5, 0.5, 1, 1, 0, 0, 0, 0}},
                 {"pixelAspectRatio", {1.5}},
                 {"screenWindowCenter", {0.25, -0.125}},
                 {"screenWindowWidth", {2.5}}};
  return map;
}

}  // namespace fathom::checks
