#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

namespace fathom::view {

/// A map to be looked at.
struct ViewedMap {
  std::string name;
  DepthMap map;
  /// With what the map was rendered; nullopt: nothing says where its points are.
  std::optional<Camera> camera;
};

/// Takes the parts of a page, one after another.
using Sink = std::function<void(std::string_view part)>;

/// Writes the page of `fathom view`: one HTML file that needs no other and no network. It holds
/// every channel of every map, bit by bit: in tiles of 512 × 512 pixels (packing.h), of large maps
/// also every second, every fourth, … pixel.
/// Needs    valid maps, at least one.
/// Fails    std::bad_alloc; as the sink.
void write_page(const std::vector<ViewedMap>& maps, const Sink& sink);

}  // namespace fathom::view
