#include "fathom/image/depth_map.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"

namespace fathom {

const ImageChannel* DepthMap::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ImageChannel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

ImageChannel* DepthMap::find(const std::string& name) {
  return const_cast<ImageChannel*>(std::as_const(*this).find(name));
}

namespace {

std::optional<std::string> find_fault_of_channels(const DepthMap& map) {
  const std::size_t pixels = std::size_t{map.width} * map.height;
  std::set<std::string_view> names;
  for (const ImageChannel& channel : map.channels) {
    if (channel.name.empty()) return "a channel has no name";
    if (channel.name.find('\0') != std::string::npos) return "the name of a channel holds a NUL";
    if (!names.insert(channel.name).second) return "it has two channels '" + channel.name + "'";
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, channel.values);
    if (size != pixels) {
      return "channel '" + channel.name + "' has " + text::counted(size, "value") +
             ", expected one for each of " + text::counted(pixels, "pixel");
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const DepthMap& map) {
  if (map.width == 0 || map.height == 0) return "it has no pixels";
  if (map.channels.empty()) return "it has no channels";
  if (auto fault = find_fault_of_channels(map)) return fault;
  if (map.png_scale && !(*map.png_scale > 0 && std::isfinite(*map.png_scale))) {
    return "png_scale is not a positive number";
  }
  return std::nullopt;
}

void require_valid(const DepthMap& map) {
  if (const auto fault = find_fault(map)) throw InputError("map: " + *fault);
}

}  // namespace fathom
