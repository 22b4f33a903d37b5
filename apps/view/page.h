#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"

namespace fathom::view {

/// A map to be looked at.
struct ViewedMap {
  std::string name;
  DepthMap map;
  /// The camera of the map; nullopt if the positions of its points are unknown.
  std::optional<Camera> camera;
  /// The samples of a deep map, whose flat_map() is `map`; nullopt for other maps.
  std::optional<DeepMap> deep;
};

/// Whether a server answers `probe?map=M&x=X&y=Y` beside the page.
enum class Questions { none, probes };

/// Takes the parts of a page, one after another.
using Sink = std::function<void(std::string_view part)>;

/// Chromium opens 1.4 GB in half a minute.
inline constexpr std::uint64_t most_page_bytes = std::uint64_t{2} << 30;

/// Writes the page of `fathom view`: one HTML file that needs no other file and no network. It
/// contains every channel of every map, bit by bit, in tiles of 512 × 512 pixels (packing.h); of
/// large maps also every second, every fourth, … pixel. `progress` is called with the share that is
/// done.
/// Needs    valid maps, at least one.
/// Fails    OutputError where the page would be larger than `most_bytes`; std::bad_alloc; as the
///          sink.
void write_page(const std::vector<ViewedMap>& maps, Questions questions, const Sink& sink,
                const std::function<void(double)>& progress = {},
                std::uint64_t most_bytes = most_page_bytes);

/// Whether a text begins as a page does, and holds the maps of a report of `fathom validate`.
bool is_report(std::string_view text);

/// The maps of a report.html: of each scene the exact map, with Z and id, and after it those of the
/// renderers, with Z and `class`, what was found about each pixel. `name` is the file's name for
/// messages. `most_bytes` is what the maps may take.
/// Fails    InputError: "NAME: is not a report of fathom validate: …".
std::vector<ViewedMap> maps_of_report(std::string_view text, const std::string& name,
                                      std::uint64_t most_bytes);

}  // namespace fathom::view
