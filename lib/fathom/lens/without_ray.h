#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fathom/camera/projection.h"

namespace fathom::lens {

/// How much of an image sees nothing, whatever the scene is.
struct WithoutRay {
  enum class Reason {
    /// Beyond the disc on which the lens is one to one.
    fold,
    max_radius,
    /// Beyond 1 + k·r² = 2 (DIVISION), beyond the root of 0 (models with a root), 90° (FOV) or
    /// 180° (fisheyes) from the axis, where the angle ceases to grow (FTHETA), or beyond a pole
    /// (EQUIRECTANGULAR).
    end_of_model,
    /// Pixels without a direction (TABLE).
    table
  };
  Reason reason;
  /// Of the image's area, in (0, 1]; of a table, of its pixels that have no direction.
  double share;
};

/// The part of an image whose samples have no ray; nullopt if there is none, or less than half a
/// pixel.
///
/// Exact    of a table; otherwise an area in binary64, bounded by the image of a polygon of 1024
///          corners, with the fold found in steps. Preimages decides each sample exactly.
/// Cost     about a millisecond; of a table, one look at each pixel.
/// Fails    never. Nothing is known, nullopt, where numbers overflow in binary64 or the tilted
///          sensor shows only a part of the disc.
std::optional<WithoutRay> find_samples_without_ray(const Projection& projection,
                                                   std::uint32_t width, std::uint32_t height);

/// Why a pixel of a camera with a lens has no ray, in a few words: "the lens folds nearer to its
/// axis".
/// Needs    a valid projection with a lens, and a pixel of which Preimages::of_pixel() finds no
///          direction.
/// Cost     as to make Preimages.
std::string why_no_ray(const Projection& projection, std::uint32_t column, std::uint32_t row);

}  // namespace fathom::lens
