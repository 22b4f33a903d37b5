#pragma once

#include <cstdint>
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
/// Fails    InputError where the map has a fault (find_fault), or there is not a count for each of
///          its pixels and a share for each that is counted.
void add_mattes(DepthMap& map, const Mattes& mattes);

}  // namespace fathom
