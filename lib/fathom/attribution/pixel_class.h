#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fathom::attribution {

/// Why a pixel differs from the truth (docs/validation.md, "Classes"): the first that applies.
enum class PixelClass : std::uint8_t {
  equal,         ///< the exact depth rounded once to the storage, or background in both
  quantization,  ///< next to the exact depth in the storage
  arithmetic,    ///< the surface is the visible one, its depth within the model's bound
  edge,          ///< another surface or none: closer to an edge than the model can resolve
  z_fight,       ///< another surface, which the model cannot tell from the visible one by depth
  missed,        ///< a ray slipped through between triangles that share an edge or a corner
  convention,    ///< explained by a fault of the whole image that was found and named
  unexplained
};
inline constexpr std::size_t pixel_class_count = 8;

/// "within quantization", "missed surface", …, as reports show it.
std::string name_of(PixelClass pixel_class);

}  // namespace fathom::attribution
