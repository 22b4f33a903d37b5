#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// Unit normals as the colours of a PNG: red, green and blue are the codes of x, y and z.
namespace fathom {

/// The axes of normals in the camera's frame (channel Nc).
enum class NormalAxes {
  opencv,  ///< x right, y down, z forward: those of the channel
  opengl   ///< x right, y up, z backward: y and z are negated
};
inline constexpr std::array all_normal_axes{NormalAxes::opencv, NormalAxes::opengl};
/// "opencv" or "opengl".
std::string_view name_of(NormalAxes axes);

/// How normals are stored in a PNG. A pixel without a surface is black: 0, 0, 0, which no unit
/// normal has.
struct NormalCoding {
  /// Of a colour: 8 or 16.
  int bits = 8;
  NormalAxes axes = NormalAxes::opencv;
};

/// The code of a component n: (n + 1)/2·(2^bits − 1), rounded to nearest, ties to even. 0 is 128 or
/// 32768, −1 is 0, 1 is 255 or 65535.
/// Exact    the exact number is rounded once. n must be in [−1, 1].
std::uint16_t code_of_normal(float n, int bits);

/// The component of a code: 2·code/(2^bits − 1) − 1, rounded once.
float normal_of_code(std::uint16_t code, int bits);

}  // namespace fathom
