#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fathom/image/cryptomatte.h"
#include "fathom/image/depth_map.h"

/// Cryptomatte as people look at it: the names that a map's layers show, instead of hashes.
/// Source   [FJ16].
namespace fathom {

/// A layer as a map contains it: what add_mattes() adds, also from other programs.
struct MatteLayer {
  /// "CryptoObject"
  std::string name;
  /// LAYER00.R, .G, .B, .A, LAYER01.R, …
  std::vector<std::string> channels;
  /// The names by their ids, in the manifest or, for other ids, as digits: "0x3ae39a58".
  std::map<std::uint32_t, std::string> names;
  /// As in Mattes.
  std::vector<std::uint32_t> counts;
  std::vector<MatteShare> shares;
};

/// Part of an image that shows a name.
struct MatteExtent {
  std::string name;
  /// Pixels that show any part of it.
  std::uint64_t pixels = 0;
  /// Sum of the coverages, in pixels.
  double area = 0;
};

/// The layers of a map, from its texts "cryptomatte/KEY/name" and its channels LAYERnn.R, .G, .B,
/// .A. The shares of a pixel end at the first one whose coverage is not positive. A layer without
/// channels is left out.
/// Fails    InputError where the map has a fault (find_fault).
std::vector<MatteLayer> matte_layers(const DepthMap& map);

/// The names that occur, in the order of names.
std::vector<MatteExtent> extents(const MatteLayer& layer);

/// The map with other channels instead of LAYERnn.R, .G, .B, .A: `LAYER`, the number of the name
/// that covers most of a pixel, or no_surface; `LAYER.coverage`, the share that it covers; then the
/// second name, `LAYER.2` and `LAYER.2.coverage`, and so on. The names are in `tables`.
/// Fails    InputError where the map has a fault (find_fault).
DepthMap with_matte_names(DepthMap map);

}  // namespace fathom
