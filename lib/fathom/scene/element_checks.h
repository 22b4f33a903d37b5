#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <span>
#include <type_traits>

#include "fathom/camera/camera.h"
#include "fathom/mesh/mesh.h"
#include "fathom/scene/triangle_source.h"

/// Quick looks at parts of the lists of a mesh, in a form that compilers turn into vector
/// instructions. To look at a large mesh takes as long as to read it from memory, a twentieth of
/// the time in which it is rendered; so who reads it anyway looks at each part just before.
namespace fathom::scene {

/// What require_valid() and require_renderable() ask (scene_fault.h), but for the vertices and
/// triangles of placed meshes: who calls these asks all_finite() and all_below() of them.
void require_valid_but_elements(const TriangleSource& triangles);
void require_renderable_but_elements(const TriangleSource& triangles, const Camera& camera);

/// Thrown where these say no, by those who do not have the scene; who has it says what is wrong
/// (require_valid).
struct ElementFault : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "a mesh is not valid"; }
};

/// Number i of those that elements consist of.
template <class Number, class T>
Number number_at(std::span<const T> elements, std::size_t i) {
  static_assert(sizeof(T) % sizeof(Number) == 0 && std::is_trivially_copyable_v<T>);
  Number number;
  std::memcpy(&number, std::as_bytes(elements).data() + i * sizeof number, sizeof number);
  return number;
}

/// Whether no number is infinite or NaN: their exponent is the greatest, and adding 1 to it carries
/// into the sign's place.
template <class Real, class T>
bool all_finite(std::span<const T> elements) {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  constexpr int fraction = std::numeric_limits<Real>::digits - 1;
  constexpr Bits sign = Bits{1} << (8 * sizeof(Real) - 1), one = Bits{1} << fraction;
  const std::size_t count = elements.size_bytes() / sizeof(Bits);
  Bits carries = 0;
  for (std::size_t i = 0; i < count; ++i) carries |= (number_at<Bits>(elements, i) & ~sign) + one;
  return (carries & sign) == 0;
}
inline bool all_finite(std::span<const MeshPoint> points) {
  return all_finite<double, MeshPoint>(points);
}

/// Whether every corner is a number below `end`.
bool all_below(std::span<const CornerIndices> triangles, std::uint64_t end);

}  // namespace fathom::scene
