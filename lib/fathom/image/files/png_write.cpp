#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/code_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/png_picture.h"
#include "fathom/image/png_files.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_text.h"
#include "fathom/text/version.h"

namespace fathom::image {
using namespace files;
using namespace text;

namespace {

std::vector<std::uint16_t> identifiers_as_codes(const Samples<std::uint32_t>& ids, bool segments,
                                                const std::string& name) {
  const std::uint32_t most = segments ? 65533 : 65534;
  std::vector<std::uint16_t> codes(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] == no_surface) {
      codes[k] = 65535;
    } else if (segments && ids[k] == no_segment) {
      codes[k] = 65534;
    } else if (ids[k] <= most) {
      codes[k] = static_cast<std::uint16_t>(ids[k]);
    } else {
      throw OutputError(name + ": identifier " + std::to_string(ids[k]) +
                        " does not fit a 16-bit PNG: expected at most " + std::to_string(most));
    }
  }
  return codes;
}

void add_texts(PngPicture& picture, const DepthMap& map, const ImageChannel& channel,
               const std::string& name) {
  picture.texts = {{"Software", software_in_outputs()}, {channel_text, channel.name}};
  if (std::holds_alternative<Samples<std::uint32_t>>(channel.values))
    picture.texts.emplace_back(type_text, "identifier");
  else if (map.png_scale)
    picture.texts.emplace_back(scale_text, text::shortest_decimal(*map.png_scale));
  if (map.codes_beyond && std::holds_alternative<Samples<std::uint16_t>>(channel.values))
    picture.texts.emplace_back(beyond_text, std::to_string(*map.codes_beyond));
  add_texts_of_map(picture, map, name);
}

}  // namespace

Bytes encode_png(const DepthMap& map, const ImageChannel& channel, const std::string& name) {
  std::vector<std::uint16_t> codes;
  if (const auto* ids = std::get_if<Samples<std::uint32_t>>(&channel.values))
    codes = identifiers_as_codes(*ids, shows_segments(channel.name), name);
  else if (const auto* stored = std::get_if<Samples<std::uint16_t>>(&channel.values))
    codes.assign(stored->begin(), stored->end());
  else
    throw OutputError(name + ": PNG holds 16-bit codes, and channel '" + channel.name +
                      "' is stored as floating point; " +
                      (kind_of(channel) == ChannelKind::depth
                           ? "give a scale, in codes per scene unit"
                           : "write " + suffixes_for_any_channel()));
  PngPicture picture{map.width, map.height, 16, PngColour::grey, {}, {}};
  picture.pixels.resize(2 * codes.size());
  for (std::size_t k = 0; k < codes.size(); ++k)
    store(&picture.pixels[2 * k], codes[k], std::endian::big);
  add_texts(picture, map, channel, name);
  return encode(picture, name);
}

}  // namespace fathom::image

namespace fathom {

namespace {

std::string json_member(const char* name, const std::string& json) {
  return text::json_string(name) + ": " + json;
}

const ImageChannel& channel_in_png(const DepthMap& map, const std::string& name) {
  if (name.empty() && map.channels.size() == 1) return map.channels.front();
  if (const ImageChannel* channel = map.find(name)) return *channel;
  if (!name.empty()) throw missing_channel(map, name);
  throw ambiguous_channel(names_of_channels(map), "the map has", "describe");
}

}  // namespace

std::string png_sidecar(const DepthMap& map, const std::string& name) {
  const StandardArithmetic standard;
  require_valid(map);
  const ImageChannel& channel = channel_in_png(map, name);
  const bool identifiers = std::holds_alternative<Samples<std::uint32_t>>(channel.values);
  std::string json = "{" + json_member("channel", text::json_string(channel.name));
  if (!identifiers && map.png_scale) {
    json += ", " + json_member("unit", text::json_string("codes per scene unit")) + ", " +
            json_member("scale", text::shortest_decimal(*map.png_scale));
  }
  json += ", " + json_member("none", identifiers ? "65535" : "0");
  if (!identifiers)
    json += ", " + json_member("beyond", std::to_string(map.codes_beyond.value_or(0)));
  json += ", " + json_member("width", std::to_string(map.width)) + ", " +
          json_member("height", std::to_string(map.height));
  return json + "}\n";
}

}  // namespace fathom
