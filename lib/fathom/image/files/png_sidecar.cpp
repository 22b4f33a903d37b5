#include "fathom/image/png_sidecar.h"

#include "fathom/failures/errors.h"
#include "fathom/image/missing_channel.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"
#include "fathom/text/shortest_decimal.h"

namespace fathom {
using namespace text;

namespace {

std::string json_member(const char* name, const std::string& json) {
  return json_string(name) + ": " + json;
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
  std::string json = "{" + json_member("channel", json_string(channel.name));
  if (!identifiers && map.png_scale) {
    json += ", " + json_member("unit", json_string("codes per scene unit")) + ", " +
            json_member("scale", shortest_decimal(*map.png_scale));
  }
  json += ", " + json_member("none", identifiers ? "65535" : "0");
  if (!identifiers)
    json += ", " + json_member("beyond", std::to_string(map.codes_beyond.value_or(0)));
  json += ", " + json_member("width", std::to_string(map.width)) + ", " +
          json_member("height", std::to_string(map.height));
  return json + "}\n";
}

}  // namespace fathom
