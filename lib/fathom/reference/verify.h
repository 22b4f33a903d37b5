#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom {

/// Pixels of an image, row by row from the top.
using PixelChoice = std::vector<bool>;

/// The seed of choose_pixels().
inline constexpr std::uint64_t verification_seed = 20260101;

/// `count` different pixels, every choice equally likely but for the generator: Floyd's algorithm
/// (Bentley and Floyd, CACM 30, 1987) over std::mt19937_64(verification_seed), the same on every
/// machine; all pixels where there are not more than `count`.
PixelChoice choose_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t count);

/// A value of a map that is not the one of the specification.
struct Disagreement {
  std::uint32_t x = 0, y = 0;
  std::string channel;
  /// In digits that tell it from every other, floats in hexadecimal too. `expected` may be the
  /// reason why the encoding cannot hold the depth.
  std::string found, expected;
};

struct Verification {
  /// Pixels that were computed again, and how many of them differ in a channel.
  std::uint64_t verified = 0, differing = 0;
  /// The first in row order, at a pixel in the order of the map's channels.
  std::optional<Disagreement> first;
};

/// Computes the chosen pixels of a rendered map again by exact arithmetic, without any part of the
/// fast engine, and compares every channel bit for bit; background too.
///
/// Exact    as the reference engine: the visible surface is that of the least exact depth among all
///          triangles that cover the sample, each value is rounded once from exact numbers.
/// Cost     the corners of every triangle are looked at once (per 4 million chosen pixels) for a box
///          that certainly contains it; only triangles whose box contains a chosen pixel are looked
///          at exactly.
/// Needs    `options` (channels, culling, encoding) as the map was rendered with; threads and
///          progress are this call's own.
Verification verify(const DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                    const RenderOptions& options, const PixelChoice& chosen);

}  // namespace fathom
