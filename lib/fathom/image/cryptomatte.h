#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fathom/image/depth_map.h"

/// Cryptomatte: which objects each pixel shows and how much of it each covers, as compositing
/// programs read it.
/// Source   [FJ16]; hash: [App11].
namespace fathom {

/// MurmurHash3_x86_32 of the text's bytes with seed 0.
std::uint32_t murmur_hash(const std::string& text);

/// The bits of the binary32 number that identifies a name: its hash, with one bit flipped where it
/// would not be a finite normal number.
std::uint32_t cryptomatte_id(const std::string& name);

/// A part of a pixel.
struct MatteShare {
  /// cryptomatte_id() of the name.
  std::uint32_t id = 0;
  /// The fraction of the pixel, in (0, 1].
  float coverage = 0;
};

/// What each pixel shows, row by row from the top left; the shares of a pixel from the greatest
/// coverage to the least, among equals the least id first.
struct Mattes {
  /// The layer, "CryptoObject".
  std::string layer;
  /// Every name that may occur.
  std::vector<std::string> names;
  /// Number of shares at each pixel; then the shares of all pixels, one pixel after another.
  std::vector<std::uint32_t> counts;
  std::vector<MatteShare> shares;
};

/// Adds the layer to a map: binary32 channels LAYERnn.R, .G, .B, .A (id and coverage of two ranks
/// each), six ranks or as many as the fullest pixel has, and the texts "cryptomatte/…" with the
/// manifest.
/// Fails    InputError if the map has a fault (find_fault), or there is not a count for each of
///          its pixels and a share for each that is counted.
void add_mattes(DepthMap& map, const Mattes& mattes);

// Reading mattes: the names that a map's layers show, instead of hashes.

/// A layer as a map contains it: what add_mattes() adds, also from other programs.
struct MatteLayer {
  /// "CryptoObject"
  std::string name;
  /// LAYER00.R, .G, .B, .A, LAYER01.R, …
  std::vector<std::string> channels;
  /// The names by their ids, in the manifest or, for other ids, as digits: "0x3ae39a58".
  std::map<std::uint32_t, std::string> names;
  /// As in Mattes: the number of shares at each pixel, then the shares.
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
/// Fails    InputError if the map has a fault (find_fault).
std::vector<MatteLayer> matte_layers(const DepthMap& map);

/// The names that occur, in the order of names.
std::vector<MatteExtent> extents(const MatteLayer& layer);

/// The map with other channels instead of LAYERnn.R, .G, .B, .A: `LAYER`, the number of the name
/// that covers most of a pixel, or no_surface; `LAYER.coverage`, the share that it covers; then the
/// second name, `LAYER.2` and `LAYER.2.coverage`, and so on. The names are in `tables`.
/// Fails    InputError if the map has a fault (find_fault).
DepthMap with_matte_names(DepthMap map);

}  // namespace fathom
