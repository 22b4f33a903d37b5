#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Content of a depth buffer: a map from depth to [0, 1], rounded to a storage type
/// (specification, section 9).
namespace fathom {

/// The map f from depth D to the stored value, given near, far and C.
/// Source   [Kem09], [Kem13] for `log`; [Ulrich] for `log_ulrich`.
enum class Mapping {
  standard,           ///< far·(D − near) / (D·(far − near))
  reversed,           ///< near·(far − D) / (D·(far − near))
  infinite,           ///< 1 − near/D
  reversed_infinite,  ///< near/D
  opengl,             ///< as standard; but a pipeline goes through z_ndc in [−1, 1]
  linear,             ///< (D − near) / (far − near)
  w,                  ///< D / far
  log,                ///< log(1 + C·D) / log(1 + C·far)
  log_ulrich,         ///< log(D / near) / log(far / near)
};
inline constexpr Mapping all_mappings[] = {
    Mapping::standard,  Mapping::reversed, Mapping::infinite, Mapping::reversed_infinite,
    Mapping::opengl,    Mapping::linear,   Mapping::w,        Mapping::log,
    Mapping::log_ulrich};

/// How the value in [0, 1] is kept: as the nearest multiple of 1/(2ⁿ − 1), or in an IEEE 754
/// format.
enum class Storage { unorm16, unorm24, unorm32, float16, float32, float64 };
inline constexpr Storage all_storages[] = {Storage::unorm16, Storage::unorm24, Storage::unorm32,
                                           Storage::float16, Storage::float32, Storage::float64};

/// Which of equal stored depths wins: the one drawn first (OpenGL's GL_LESS, GL_GREATER) or the one
/// drawn last (GL_LEQUAL, GL_GEQUAL).
enum class EqualDepths { first_wins, last_wins };

/// A depth format. `near` and `far` bound the planar depths that it takes, in scene units; far is
/// +∞ if the mapping allows it. `c` is only used by `log`.
struct DepthFormat {
  Mapping mapping = Mapping::standard;
  Storage storage = Storage::float32;
  double near = 0.1;
  double far = 1000;
  double c = 1;
};

/// Refuses a meaningless format; the functions of this module expect a checked format.
/// Fails    UsageError, naming the value and the existing combinations.
void require_meaningful(const DepthFormat& format);

/// The names used in the specification. Fails with UnknownName, which lists the existing
/// names. A storage is also found by its name in OpenGL, Vulkan, Direct3D and WebGPU: D24S8.
std::string_view name_of(Mapping mapping);
std::string_view name_of(Storage storage);
Mapping mapping_named(std::string_view name);
Storage storage_named(std::string_view name);

/// Whether nearer depths have greater stored values.
constexpr bool is_reversed(Mapping mapping) {
  return mapping == Mapping::reversed || mapping == Mapping::reversed_infinite;
}
/// Whether far may be +∞.
constexpr bool takes_infinite_far(Mapping mapping) {
  return mapping == Mapping::infinite || mapping == Mapping::reversed_infinite;
}
/// Whether the map is a quotient of logarithms.
constexpr bool is_logarithmic(Mapping mapping) {
  return mapping == Mapping::log || mapping == Mapping::log_ulrich;
}
constexpr bool is_unorm(Storage storage) {
  return storage <= Storage::unorm32;
}
/// Bits of a unorm storage; bits of the significand, without the hidden one, of a float storage.
constexpr int bits_of(Storage storage) {
  constexpr int bits[] = {16, 24, 32, 10, 23, 52};
  return bits[static_cast<int>(storage)];
}
/// The greatest code of a unorm storage, which means 1.
constexpr std::uint32_t greatest_code(Storage storage) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << bits_of(storage)) - 1);
}
/// The exponent of the least normal number of a float storage. A number's exponent is stored with
/// 1 − least_exponent() added to it.
constexpr int least_exponent(Storage storage) {
  return storage == Storage::float16 ? -14 : storage == Storage::float32 ? -126 : -1022;
}

}  // namespace fathom
