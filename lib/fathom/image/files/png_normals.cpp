#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/png_picture.h"
#include "fathom/image/png_files.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/version.h"

namespace fathom {

std::string_view name_of(NormalAxes axes) {
  return axes == NormalAxes::opencv ? "opencv" : "opengl";
}

std::uint16_t code_of_normal(float n, int bits) {
  // n·(2^bits − 1)/2 has at most 40 bits. The code is that plus a half less than 2^(bits − 1), so
  // it is a tie only if n is 0, since no other binary fraction in [−1, 1] makes it a whole number.
  const double greatest = bits == 8 ? 255 : 65535;
  const double middle = bits == 8 ? 128 : 32768;
  return static_cast<std::uint16_t>(middle + std::floor(static_cast<double>(n) * greatest / 2));
}

float normal_of_code(std::uint16_t code, int bits) {
  // Both are whole numbers below 2²⁴, so the quotient is the only rounding.
  const int greatest = bits == 8 ? 255 : 65535;
  return static_cast<float>(2 * code - greatest) / static_cast<float>(greatest);
}

namespace image {
using namespace files;

namespace {

using Normal = std::array<float, 3>;

/// 0 in all three means no surface.
bool is_none(const Normal& n) {
  return n == Normal{0, 0, 0};
}

void check(const NormalCoding& coding, const std::string& channel) {
  if (coding.bits != 8 && coding.bits != 16) {
    throw UsageError(Setting{"normal_bits"}, "expected 8 or 16 for normals in a PNG");
  }
  if (coding.axes == NormalAxes::opengl && channel != "Nc") {
    throw UsageError(Setting{"normal_axes"},
                     "those of OpenGL are for channel Nc, normals in the camera's "
                     "frame, not for " +
                         channel);
  }
}

}  // namespace

Bytes encode_normals(const DepthMap& map, const std::vector<const ImageChannel*>& parts,
                     const NormalCoding& coding, const std::string& name) {
  const std::string channel = parts[0]->name.substr(0, parts[0]->name.rfind('.'));
  check(coding, channel);
  std::array<const Samples<float>*, 3> values{};
  for (std::size_t part = 0; part < 3; ++part) {
    values[part] = std::get_if<Samples<float>>(&parts[part]->values);
    if (values[part] == nullptr) {
      throw OutputError(name + ": normals of a PNG are float32, and " + parts[part]->name +
                        " is not");
    }
  }
  const std::size_t bytes_per_code = coding.bits == 8 ? 1 : 2;
  const bool flips = coding.axes == NormalAxes::opengl;
  PngPicture picture{map.width, map.height, coding.bits, PngColour::rgb, {}, {}};
  const std::size_t pixels = values[0]->size();
  picture.pixels.resize(3 * bytes_per_code * pixels);
  for (std::size_t k = 0; k < pixels; ++k) {
    const Normal n{(*values[0])[k], (*values[1])[k], (*values[2])[k]};
    if (is_none(n)) continue;
    for (std::size_t part = 0; part < 3; ++part) {
      if (!(std::abs(n[part]) <= 1)) {
        throw OutputError(name + ": " + place_of_pixel(k, map.width) + parts[part]->name +
                          " is not from -1 to 1: no normal of length 1");
      }
      const std::uint16_t code =
          code_of_normal(flips && part > 0 ? -n[part] : n[part], coding.bits);
      std::byte* const at = &picture.pixels[bytes_per_code * (3 * k + part)];
      if (coding.bits == 8) {
        *at = static_cast<std::byte>(code);
      } else {
        store(at, code, std::endian::big);
      }
    }
  }
  picture.texts = {
      {"Software", text::software_in_outputs()}, {channel_text, channel}, {type_text, normal_type}};
  if (flips) picture.texts.emplace_back(axes_text, std::string(name_of(coding.axes)));
  add_texts_of_map(picture, map, name);
  return encode(picture, name);
}

std::vector<ImageChannel> normals_from(ByteView pixels, std::size_t count, int bits, bool flips,
                                       const std::string& channel) {
  std::array<Samples<float>, 3> values{Samples<float>(count), Samples<float>(count),
                                       Samples<float>(count)};
  for (std::size_t k = 0; k < count; ++k) {
    std::array<std::uint16_t, 3> codes{};
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t at = 3 * k + part;
      codes[part] = bits == 8 ? static_cast<std::uint16_t>(pixels[at])
                              : load<std::uint16_t>(&pixels[2 * at], std::endian::big);
    }
    if (codes == std::array<std::uint16_t, 3>{}) continue;
    for (std::size_t part = 0; part < 3; ++part) {
      const float n = normal_of_code(codes[part], bits);
      values[part][k] = flips && part > 0 ? -n : n;
    }
  }
  std::vector<ImageChannel> channels;
  for (std::size_t part = 0; part < 3; ++part) {
    channels.push_back({channel + "." + "XYZ"[part], std::move(values[part])});
  }
  return channels;
}

}  // namespace image

std::vector<std::byte> encode_mask(const DepthMap& map, const std::string& name,
                                   std::optional<std::uint32_t> object) {
  const StandardArithmetic standard;
  require_valid(map);
  std::vector<std::uint8_t> shown;
  if (object) {
    const auto* const objects = map.values<std::uint32_t>("object");
    if (objects == nullptr) throw UsageError("the mask of an object needs channel object");
    shown.resize(objects->size());
    std::ranges::transform(*objects, shown.begin(),
                           [&](std::uint32_t each) { return each == *object; });
  } else if (const auto* const mask = map.values<float>("mask")) {
    shown.resize(mask->size());
    std::ranges::transform(*mask, shown.begin(), [](float value) { return value != 0; });
  } else {
    const ImageChannel* const depth = map.find("Z");
    shown = surface_mask(map, depth != nullptr ? *depth : map.channels.front());
  }
  image::PngPicture picture = image::picture_of_mask(shown, map.width, map.height);
  picture.texts.emplace_back(image::channel_text, "mask");
  picture.texts.emplace_back(image::type_text, image::mask_type);
  image::add_texts_of_map(picture, map, name);
  return image::encode(picture, name);
}

}  // namespace fathom
