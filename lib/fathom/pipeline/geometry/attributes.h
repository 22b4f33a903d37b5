#pragma once

#include <array>
#include <cstddef>

namespace fathom::pipeline {

/// What vertices carry to fragments, by the index of its first component.
namespace attribute {
inline constexpr std::size_t depth = 0;   ///< along the view, scene units
inline constexpr std::size_t world = 1;   ///< position, three
inline constexpr std::size_t normal = 4;  ///< in the world, not of unit length, three
inline constexpr std::size_t uv = 7;      ///< texture coordinates, two
inline constexpr std::size_t colour = 9;  ///< linear, three
inline constexpr std::size_t count = 12;
}  // namespace attribute

template <class Real>
using Attributes = std::array<Real, attribute::count>;

}  // namespace fathom::pipeline
