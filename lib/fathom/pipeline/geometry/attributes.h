#pragma once

#include <array>
#include <cstddef>

namespace fathom::pipeline {

/// What vertices carry to fragments, by the index of its first component.
namespace attribute {
inline constexpr std::size_t depth = 0;  ///< along the view, scene units
inline constexpr std::size_t world = 1;  ///< position, three
/// In the world, three: of unit length at the corners of the mesh, on the side of the triangle
/// that is the front for an unmirrored camera.
inline constexpr std::size_t normal = 4;
inline constexpr std::size_t uv = 7;      ///< texture coordinates, two
inline constexpr std::size_t colour = 9;  ///< linear, three
/// How many of them fragments get.
inline constexpr std::size_t of_fragments = 12;
/// Gouraud's light at the corners, diffuse and specular, for either side of the surface.
inline constexpr std::size_t front_light = 12, back_light = 14;
inline constexpr std::size_t count = 16;
}  // namespace attribute

template <class Real>
using Attributes = std::array<Real, attribute::count>;

}  // namespace fathom::pipeline
