#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "fathom/mesh/mesh.h"
#include "fathom/scene/triangle_source.h"

/// Parts of the check of a scene (scene_fault.h). The checks of the lists of a mesh have a form
/// that compilers turn into vector instructions. Checking a large mesh takes as long as reading it
/// from memory, 5 % of the render time. Code that reads the mesh anyway therefore checks each part
/// just before using it.
namespace fathom::scene {

/// The part of find_fault() that looks at no mesh: whether objects name meshes that are there, and
/// their triangles can be counted.
std::optional<std::string> find_fault_of_objects(const Scene& scene);
std::optional<std::string> find_fault_of_objects(const StreamedScene& scene);

/// Fails    InputError, "scene: " and the fault, if there is one.
void require(const std::optional<std::string>& no_fault);

/// Thrown where all_finite() or all_below() say no, by those who do not have the scene.
struct ElementFault : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "a mesh is not valid"; }
};

/// Throws the fault of a scene that contains an ElementFault.
/// Fails    InputError.
[[noreturn]] void fail_of_elements(const TriangleSource& triangles);

/// Calls work(), which checks elements after require_valid(…, LookAtElements::later): an
/// ElementFault becomes the exception of require_valid() for the whole scene.
template <class Work>
auto explaining_faults(const TriangleSource& triangles, const Work& work) {
  try {
    return work();
  } catch (const ElementFault&) {
    fail_of_elements(triangles);
  }
}

/// Number i of the components of an element.
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
