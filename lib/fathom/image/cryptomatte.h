#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/image/depth_map.h"

/// Cryptomatte: for each pixel which objects it shows and how much of it each covers, as
/// compositing programs read it.
/// Source   Jonah Friedman and Andrew C. Jones, Cryptomatte Specification, version 1.2.0, Psyop,
///          2016; hash: Austin Appleby, MurmurHash3 (x86, 32 bits), seed 0.
namespace fathom {

/// MurmurHash3_x86_32 of the text's bytes with the seed 0.
std::uint32_t murmur_hash(const std::string& text);

/// The bits of the binary32 number that stands for a name: its hash, of which a bit is turned where
/// it would be no finite normal number.
std::uint32_t cryptomatte_id(const std::string& name);

/// A part of a pixel.
struct MatteShare {
  /// cryptomatte_id() of the name.
  std::uint32_t id = 0;
  /// In (0, 1].
  float coverage = 0;
};

/// What a pixel shows, for all pixels, row by row; each pixel's shares from the greatest coverage
/// to the least, among equals the least id first.
struct Mattes {
  /// The layer, "CryptoObject".
  std::string layer;
  /// Every name that may occur.
  std::vector<std::string> names;
  std::vector<std::uint32_t> counts;
  std::vector<MatteShare> shares;
};

/// Adds the layer to a map: channels LAYERnn.R, .G, .B, .A (id and coverage of two ranks each), six
/// ranks or as many as the fullest pixel has, and the texts "cryptomatte/…" with the manifest.
void add_mattes(DepthMap& map, const Mattes& mattes);

}  // namespace fathom
