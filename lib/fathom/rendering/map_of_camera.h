#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/mesh/segmentation.h"
#include "fathom/rendering/options.h"

/// Where the values of a map's channels are.
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

// A camera's map before anything is drawn, and the check that a map is a camera's.

/// The map of a scene without a visible surface: every requested channel, once, with its background
/// (specification, section 6), in the requested encoding. Takes the memory of channels of `before`
/// that have the same name, type and size.
DepthMap make_background(const Camera& camera, const RenderOptions& options,
                         const RenderContext& context = {}, DepthMap before = {});

/// Refuses channels that no map of the camera has: A, where edges are curves.
/// Fails    UsageError.
void require_channels_of(const Camera& camera, const RenderOptions& options);

/// The background of a map's channels, for filling a map part by part.
class MapBackground {
 public:
  /// Fills `count` pixels from this pixel on (row · width + column). Several threads may fill
  /// different pixels at the same time.
  void fill(std::size_t first_pixel, std::size_t count) const;
  /// Calls visit(values of the channel, its background) for each.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Filled& channel : channels_) {
      std::visit([&](const auto& values) { visit(values.first, values.background); },
                 channel.values);
    }
  }

  template <class T>
  void add(const std::string& channel, T* values, T background) {
    channels_.push_back({channel, Values<T>{values, background}});
  }
  void leave_out(std::string_view channel) {
    std::erase_if(channels_, [&](const Filled& filled) { return filled.name == channel; });
  }

 private:
  template <class T>
  struct Values {
    T* first;
    T background;
  };
  struct Filled {
    std::string name;
    std::variant<Values<float>, Values<double>, Values<std::uint16_t>, Values<std::uint32_t>>
        values;
  };
  std::vector<Filled> channels_;
};

struct UnfilledMap {
  DepthMap map;
  /// Of the channels that do not have it yet.
  MapBackground background;
};
/// make_background(), but filling it is left to the caller.
UnfilledMap make_unfilled_map(const Camera& camera, const RenderOptions& options,
                              const RenderContext& context = {}, DepthMap before = {});

/// A map to which something is added, or which is looked at again: one of the camera's size.
/// Fails    InputError where the map has a fault (find_fault) or another size.
void require_map_of(const Camera& camera, const DepthMap& map);

}  // namespace fathom::rendering
