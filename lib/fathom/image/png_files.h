#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/depth_map.h"

/// PNG files beyond write_map(): sidecars, masks, and normals as colours.
namespace fathom {

/// The meaning of the codes of a 16-bit PNG, for programs that read no text chunks: a JSON object
/// on one line, with a line end.
///   channel   the channel that is written: the channel of this name, or the map's only channel
///   unit      the unit of `scale`: "codes per scene unit"
///   scale     a depth is code / scale; missing for identifiers
///   none      the code where no surface is: 0; 65535 of identifiers
///   beyond    how many pixels show a surface that lies too deep for the codes and has `none`
///   width, height   pixels
/// Fails    UsageError if there is no such channel, or several channels and no name is given;
///          InputError if the map has a fault.
std::string png_sidecar(const DepthMap& map, const std::string& channel = "");

/// A mask as the bytes of a PNG of one 8-bit grey channel, 255 where the mask is not 0 and else 0,
/// as in mask/ and mask_visib/ of BOP data sets. The same mask gives the same bytes.
///   mask    height × width values, row by row from the top
///   name    the file's name for messages
/// Fails    InputError if the mask has no pixels, or another number of pixels than the size, or the
///          size is above 2^31 − 1.
std::vector<std::byte> encode_mask(std::span<const std::uint8_t> mask, std::uint32_t width,
                                   std::uint32_t height, const std::string& name);

/// The mask of a map, with its camera and texts, by which read_map() reads it as a channel `mask`
/// of 1 and 0: 255 where its channel `mask` is not 0, if it has one; or else where it shows a
/// surface (surface_mask() of Z, or of the first channel), or this object.
/// Fails    InputError if the map has a fault; UsageError if an object is asked for and the map has
///          no channel `object`; OutputError if a text does not fit PNG.
std::vector<std::byte> encode_mask(const DepthMap& map, const std::string& name,
                                   std::optional<std::uint32_t> object = std::nullopt);

/// Writes a mask to a file. Fails as encode_mask(), and OutputError, "PATH: why", if it cannot be
/// written.
void write_mask(std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height,
                const std::filesystem::path& path);

// Unit normals as the colours of a PNG: red, green and blue are the codes of x, y and z.

/// The axes of normals in the camera's frame (channel Nc).
enum class NormalAxes {
  opencv,  ///< x right, y down, z forward, as in the channel
  opengl   ///< x right, y up, z backward: y and z are negated
};
inline constexpr std::array all_normal_axes{NormalAxes::opencv, NormalAxes::opengl};
/// "opencv" or "opengl".
std::string_view name_of(NormalAxes axes);

/// How normals are stored in a PNG. A pixel without a surface is black: 0, 0, 0, which no unit
/// normal has.
struct NormalCoding {
  /// Bits of a colour: 8 or 16.
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
