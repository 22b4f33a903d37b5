#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "fathom/image/depth_map.h"
#include "fathom/mesh/segmentation.h"

/// Where the values of a map's channels are, and their values without a surface.
namespace fathom::rendering {

/// The values of binary32 and binary64 channels where no surface is visible.
struct Backgrounds {
  static constexpr float depth = std::numeric_limits<float>::infinity();
  static constexpr float position = std::numeric_limits<float>::quiet_NaN();
  static constexpr float other = 0;
};

/// Memory of a channel that is stored as a DepthEncoding: one pointer is not null, or all are null
/// if the channel was not requested.
struct EncodedValues {
  float* binary32 = nullptr;
  double* binary64 = nullptr;
  std::uint16_t* codes = nullptr;

  [[nodiscard]] bool wanted() const { return binary32 || binary64 || codes; }
};

/// Values of the requested channels about the origin of triangles.
struct OriginNumbers {
  std::uint32_t face = 0, object = 0;
  /// In the order of Segmentation.
  std::array<std::uint32_t, all_segmentations.size()> segments{};

  static constexpr std::size_t count = 2 + all_segmentations.size();
  /// In this order.
  [[nodiscard]] std::array<std::uint32_t, count> all() const {
    std::array<std::uint32_t, count> numbers{face, object};
    std::copy(segments.begin(), segments.end(), numbers.begin() + 2);
    return numbers;
  }
};

/// Pointers to the values of a map's channels; null if a channel was not requested.
struct ChannelValues {
  explicit ChannelValues(DepthMap& map);

  /// Whether a channel of OriginNumbers was requested.
  [[nodiscard]] bool wants_origins() const;
  void write(std::size_t pixel, const OriginNumbers& numbers) const;
  /// In the order of OriginNumbers::all(); null if not requested.
  [[nodiscard]] std::array<std::uint32_t*, OriginNumbers::count> origins() const {
    std::array<std::uint32_t*, OriginNumbers::count> values{face, object};
    std::copy(segments.begin(), segments.end(), values.begin() + 2);
    return values;
  }

  EncodedValues depth, distance;
  /// Not filled by ChannelWriter: A is not a value of a single surface.
  float* coverage = nullptr;
  float* low = nullptr;
  /// Not filled by ChannelWriter: it is 1 for samples without a surface, too.
  std::uint32_t* valid = nullptr;
  std::uint32_t *id = nullptr, *face = nullptr, *object = nullptr;
  std::array<std::uint32_t*, all_segmentations.size()> segments{};
  std::array<float*, 3> normal{}, camera_normal{}, shading_normal{};
  std::array<float*, 3> position{};
  std::array<float*, 2> barycentric{};
};

}  // namespace fathom::rendering
