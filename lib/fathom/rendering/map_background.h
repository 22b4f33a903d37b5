#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"

/// A camera's map before anything is drawn, and the check that a map is a camera's.
namespace fathom::rendering {

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
