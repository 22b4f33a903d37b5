#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// Which pixels of an image are chosen, row by row from the top left.
using PixelChoice = std::vector<bool>;

/// The seed of choose_pixels().
inline constexpr std::uint64_t verification_seed = 20260101;

/// `count` different pixels, every choice as likely as every other, as far as the generator allows:
/// Floyd's algorithm over std::mt19937_64(verification_seed), with the same result on every
/// machine; all pixels if there are no more than `count`.
/// Source   [BF87]
PixelChoice choose_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t count);

/// A value of a map that differs from the value of the specification.
struct Disagreement {
  std::uint32_t x = 0, y = 0;
  std::string channel;
  /// With enough digits to distinguish it from every other value; floats also in hexadecimal.
  /// `expected` may be the reason why the encoding cannot hold the depth.
  std::string found, expected;
};

struct Verification {
  /// Pixels that were computed again, and how many of them differ in a channel.
  std::uint64_t verified = 0, differing = 0;
  /// The first in row order, and at a pixel in the order of the map's channels.
  std::optional<Disagreement> first;
};

/// Computes the chosen pixels of a rendered map again by exact arithmetic, without any part of the
/// fast engine, and compares every channel bit for bit, including background.
///
/// Exact    as the reference engine: the visible surface is the surface of the least exact depth
///          among all triangles that cover the sample; each value is rounded once from exact
///          numbers.
/// Cost     the corners of every triangle are read once (per 4 million chosen pixels) for a box
///          that certainly contains it; only triangles whose box contains a chosen pixel are tested
///          exactly.
/// Needs    in `options` the channels, culling and encoding with which the map was rendered;
///          threads are this call's own.
/// Fails    InputError where map, scene or camera has a fault (find_fault), or the map is not of
///          the camera's size; UsageError for meaningless options (require_meaningful), for a
///          requested channel that the map does not have in this form, or if there are not as many
///          choices as pixels.
Verification verify(const DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                    const RenderOptions& options, const PixelChoice& chosen,
                    const std::function<void(double)>& progress = {});

}  // namespace fathom
