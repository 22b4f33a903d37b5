#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/surface.h"
#include "fathom/text/decimal.h"

/// The dense maps of COLMAP ([SZPF16], src/colmap/mvs/mat.h and .cc): width, height and channels in
/// decimal, each ended by "&", then binary32, little endian: one channel after the other, row by
/// row from the top, each row from the left.
///   1 channel   planar depth; values that are not above 0 mean no depth (fusion.cc). COLMAP itself
///               writes 0 there, and Fathom accepts only 0: a negative depth is more likely another
///               convention
///   3 channels  the normal in the camera frame, x right, y down, z forward, on the side of the
///               camera (patch_match_cuda.cu: its product with the viewing ray is not positive); 0
///               0 0 where there is none (normal_map.cc)
namespace fathom::image {
using namespace files;
using namespace text;

namespace {

constexpr std::array<const char*, 3> normal_channels{"Nc.X", "Nc.Y", "Nc.Z"};

struct ColmapHeader {
  std::uint32_t width = 0, height = 0, channels = 0;
  std::size_t size = 0;  // bytes
};

/// What std::from_chars takes of the front, and the "&" behind it.
bool take_count(std::string_view& text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end == text.data() + text.size() || *end != '&') return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return true;
}

ColmapHeader colmap_header(ByteView bytes, const std::string& name) {
  // Three numbers of ten digits each at most.
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 33));
  std::string_view rest = text;
  ColmapHeader header;
  if (!take_count(rest, header.width) || !take_count(rest, header.height) ||
      !take_count(rest, header.channels) || header.width == 0 || header.height == 0) {
    throw InputError(name +
                     ": not a usable COLMAP map: expected a width, a height and a number of "
                     "channels, from 1 to 4294967295, each ended by &");
  }
  if (header.channels != 1 && header.channels != 3) {
    throw InputError(name + ": a COLMAP map of " + std::to_string(header.channels) +
                     " channels: expected 1, of depths, or 3, of normals");
  }
  header.size = text.size() - rest.size();
  return header;
}

float depth_from(float stored, std::size_t k, std::uint32_t width, const std::string& name) {
  if (stored == 0) return std::numeric_limits<float>::infinity();
  if (stored > 0 && std::isfinite(stored)) return stored;
  throw InputError(name + ": " + place_of_pixel(k, width) + "depth " + shortest_decimal(stored) +
                   " in a COLMAP map: expected a finite number above 0, or 0 for none");
}

float normal_from(float stored, std::size_t k, std::uint32_t width, const std::string& name) {
  if (std::isfinite(stored)) return stored;
  throw InputError(name + ": " + place_of_pixel(k, width) + "a normal with " +
                   shortest_decimal(stored) + " in a COLMAP map: expected finite numbers");
}

float depth_to(float depth, std::size_t k, std::uint32_t width, const std::string& name) {
  if (depth > 0 && std::isfinite(depth)) return depth;
  throw OutputError(
      name + ": " + place_of_pixel(k, width) + "depth " + shortest_decimal(depth) +
      " cannot be in a COLMAP map, which holds finite numbers above 0; .exr holds all");
}

float normal_to(float component, std::size_t k, std::uint32_t width, const std::string& name) {
  if (std::isfinite(component)) return component;
  throw OutputError(name + ": " + place_of_pixel(k, width) + "a normal with " +
                    shortest_decimal(component) +
                    " cannot be in a COLMAP map, which holds finite numbers; .exr holds all");
}

/// Whether these are what COLMAP has: Z, or the parts of Nc in order.
bool are_of_colmap(const std::vector<const ImageChannel*>& channels) {
  if (channels.size() == 1) return channels[0]->name == "Z";
  return std::ranges::equal(channels, normal_channels, {}, &ImageChannel::name);
}

}  // namespace

Bytes encode_colmap(const DepthMap& map, const std::vector<const ImageChannel*>& channels,
                    const std::string& name) {
  if (!are_of_colmap(channels)) {
    throw OutputError(
        name +
        ": a COLMAP map holds planar depth, channel Z, or normals in the camera frame, "
        "channel Nc, not '" +
        channels[0]->name + "'");
  }
  Bytes bytes;
  append(bytes, std::to_string(map.width) + "&" + std::to_string(map.height) + "&" +
                    std::to_string(channels.size()) + "&");
  std::size_t position = bytes.size();
  const std::size_t pixels = std::size_t{map.width} * map.height;
  bytes.resize(position + sizeof(float) * pixels * channels.size());
  const auto checked = channels.size() == 1 ? depth_to : normal_to;
  for (const ImageChannel* channel : channels) {
    const auto* values = std::get_if<Samples<float>>(&channel->values);
    if (!values)
      throw OutputError(name + ": a COLMAP map holds binary32 numbers, and channel '" +
                        channel->name + "' is stored otherwise");
    const std::vector<std::uint8_t> surface = surface_mask(map, *channel);
    for (std::size_t k = 0; k < pixels; ++k, position += sizeof(float)) {
      const float value = surface[k] ? checked((*values)[k], k, map.width, name) : 0;
      store(&bytes[position], value, std::endian::little);
    }
  }
  return bytes;
}

DepthMap decode_colmap(ByteView bytes, const std::string& name) {
  const ColmapHeader header = colmap_header(bytes, name);
  const ByteView data = bytes.subspan(header.size);
  require_raw_pixels(data, header.width, header.height, sizeof(float) * header.channels,
                     "COLMAP map", name);
  DepthMap map;
  map.width = header.width;
  map.height = header.height;
  const std::size_t pixels = std::size_t{map.width} * map.height;
  const auto checked = header.channels == 1 ? depth_from : normal_from;
  for (std::size_t c = 0; c < header.channels; ++c) {
    Samples<float> values(pixels);
    const std::byte* stored = data.data() + sizeof(float) * pixels * c;
    for (std::size_t k = 0; k < pixels; ++k)
      values[k] =
          checked(load<float>(stored + sizeof(float) * k, std::endian::little), k, map.width, name);
    map.channels.push_back({header.channels == 1 ? "Z" : normal_channels[c], std::move(values)});
  }
  return map;
}

}  // namespace fathom::image
